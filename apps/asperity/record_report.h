#pragma once

#include <string>
#include <vector>

#include "asperity/base/config.h"
#include "asperity/camera/frame_writer.h"
#include "asperity/recorder/recorder_snapshot.h"
#include "asperity/verdict/verdict.h"

namespace asperity::app {

struct RecordOutcome {
  std::string recording;  // its folder
  std::string end;        // why: "duration", "key", "signal", "inputs_ended"
  RecorderSnapshot recorder;
  FrameWriter::FrameCounts frames;
  Verdicts verdicts;
};

// The outcome as one JSON object, with the settings.
std::string record_json(const RecordOutcome& outcome, const std::vector<ConfigField>& config);
// And in a few lines for a person.
std::string record_text(const RecordOutcome& outcome);

}  // namespace asperity::app
