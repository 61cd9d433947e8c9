#pragma once

#include "asperity/camera/frame_writer.h"
#include "asperity/recorder/recorder_snapshot.h"
#include "asperity/verdict/judge_recording.h"

namespace asperity::app {

// How a recording has gone, for judge_recording. `awaits_contact`: the mode `auto`.
RecordingEvidence recording_evidence(const RecorderSnapshot& end, const FrameWriter::FrameCounts& frames,
                                     bool awaits_contact, bool calibrated);

}  // namespace asperity::app
