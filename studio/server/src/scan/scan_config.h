#pragma once

#include <map>
#include <string>
#include <vector>

#include "asperity/base/config.h"
#include "asperity/live/live_config.h"
#include "asperity/live/scan_hints_config.h"
#include "asperity/pipeline/process_config.h"
#include "asperity/recorder/recorder_config.h"
#include "asperity/tracking/track_body.h"
#include "scan/bench_config.h"

namespace asperity::studio {

// All settings of a scan. What the live estimate shares with the processing afterwards is set once, under `process`.
struct ScanConfig {
  RecorderConfig recorder;
  TrackConfig track;
  ProcessConfig process;
  LiveProfileConfig live;
  ScanHintsConfig hints;
  BenchConfig bench;
};

// Its fields that can be set, in the order of the form.
std::vector<ConfigField> scan_fields(ScanConfig& config);

// The defaults with `settings`, values as in TOML by their paths. Throws Error naming a path that there is not, or a
// value that is not allowed.
ScanConfig make_scan_config(const std::map<std::string, std::string>& settings);

// Throws Error for settings that contradict each other.
void check_scan_config(const ScanConfig& config);

// True for a path that takes effect while the sensors stay open.
bool is_tuned_live(std::string_view path);

}  // namespace asperity::studio
