#pragma once

#include <string>
#include <vector>

#include "asperity/recorder/recorder_snapshot.h"

namespace asperity::app {

struct RecordVerdictConfig {
  double largest_lost_share = 0.01;
  double smallest_seen_share = 0.5;

  template <class V>
  void visit(V& v) {
    v.field("largest_lost_share", largest_lost_share, "lost probe samples above which a recording is not to be trusted",
            {0.0, 1.0});
    v.field("smallest_seen_share", smallest_seen_share,
            "frames with a pose below which a recording is not to be trusted", {0.0, 1.0});
  }
};

struct RecordVerdict {
  std::vector<std::string> doubts;    // why it is not to be trusted; empty: it is
  std::vector<std::string> warnings;  // what a person should know besides
};

// How a recording has gone. `asked_for_contact`: the mode `auto`.
RecordVerdict judge_recording(const RecorderSnapshot& end, bool asked_for_contact, bool calibrated,
                              const RecordVerdictConfig& config);

}  // namespace asperity::app
