#include "scan/scan_config.h"

#include <string_view>
#include <utility>

#include "asperity/live/live_profile.h"
#include "asperity/live/scan_hints.h"
#include "asperity/recorder/contact_detector.h"
#include "asperity/recording/uncalibrated.h"

namespace asperity::studio {

namespace {

// Of the live estimate's settings those that the processing afterwards has not.
bool is_shared(std::string_view path) {
  return path.starts_with("live.fused.") || path.starts_with("live.base.") || path.starts_with("live.profile.");
}

// The page's own: its mode is the switch "Auto", and it begins on request.
bool is_steered(std::string_view path) { return path == "recorder.mode" || path == "recorder.start_at_once"; }

}  // namespace

std::vector<ConfigField> scan_fields(ScanConfig& config) {
  std::vector<ConfigField> out;
  const auto take = [&out](std::vector<ConfigField> fields) {
    for (ConfigField& field : fields) {
      if (!is_shared(field.path) && !is_steered(field.path)) out.push_back(std::move(field));
    }
  };
  take(list_fields("process", config.process));
  take(list_fields("live", config.live));
  take(list_fields("hints", config.hints));
  take(list_fields("recorder", config.recorder));
  take(list_fields("track", config.track));
  take(list_fields("bench", config.bench));
  return out;
}

ScanConfig make_scan_config(const std::map<std::string, std::string>& settings) {
  ScanConfig out;
  const std::vector<ConfigField> fields = scan_fields(out);
  for (const auto& [path, value] : settings) {
    if (!path.starts_with("live.")) set_field(fields, path, value);
  }
  out.live = ProcessMethods::get(out.process.method).live_config(out.process);
  for (const auto& [path, value] : settings) {
    if (path.starts_with("live.")) set_field(fields, path, value);
  }
  return out;
}

void check_scan_config(const ScanConfig& config) {
  const Calibration any = make_uncalibrated(0.0, 0.0, 0.0);
  RecordingInfo info;
  info.probe_rate_Hz = 4000.0;
  info.tracker_rate_Hz = 60.0;
  LiveProfile(any, info, config.live);
  ScanAdvisor(any, info, config.hints, true);
  ContactDetector(config.recorder.contact, any.force);
}

bool is_tuned_live(std::string_view path) {
  return path.starts_with("process.") || path.starts_with("live.") || path.starts_with("hints.");
}

}  // namespace asperity::studio
