#pragma once

#include <string>
#include <string_view>

#include "asperity/base/progress.h"
#include "asperity/recording/read_limits.h"
#include "asperity/recording/recording.h"

namespace asperity {

// The files of a recording, from text in memory. `name` is what messages call the file. Each throws
// Error naming the file and the line or key; what was repaired or left out is appended to `problems`.

RecordingInfo parse_recording_info(std::string_view text, const std::string& name, const ReadLimits& limits = {},
                                   const Observer& observer = {});
Calibration parse_calibration(std::string_view text, const std::string& name, const ReadLimits& limits = {},
                              const Observer& observer = {});

ProbeStream parse_probe_csv(std::string_view text, const std::string& name, Problems& problems,
                            const ReadLimits& limits = {});
TrackerStream parse_tracker_csv(std::string_view text, const std::string& name, Problems& problems,
                                const ReadLimits& limits = {});
// As parse_tracker_csv for a body's own file; without a row it is empty, with a problem `body_unseen`.
TrackerStream parse_body_csv(std::string_view text, const std::string& name, Problems& problems,
                             const ReadLimits& limits = {});
Truth parse_truth_csv(std::string_view text, const std::string& name, Problems& problems,
                      const ReadLimits& limits = {});

}  // namespace asperity
