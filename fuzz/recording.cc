// Files in one input, each after a line "%%%": recording.json, calibration.json, probe.csv, tracker.csv, and the stream
// of each body that the first lists.
#include <array>

#include "asperity/base/error.h"
#include "asperity/recording/inspect_recording.h"
#include "asperity/recording/parse_recording.h"
#include "asperity/recording/validate_recording.h"
#include "fuzz_input.h"

using namespace asperity;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::string_view kMark = "%%%\n";
  std::string_view rest = fuzz_text(data, size);
  const auto next_file = [&] {
    const auto end = rest.find(kMark);
    const std::string_view file = rest.substr(0, end);
    rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + kMark.size());
    return file;
  };
  std::array<std::string_view, 4> files;
  for (auto& file : files) file = next_file();
  Recording recording;
  try {
    recording.info = parse_recording_info(files[0], "recording.json");
    recording.calibration = parse_calibration(files[1], "calibration.json");
    recording.probe = parse_probe_csv(files[2], "probe.csv", recording.problems);
    recording.tracker = parse_tracker_csv(files[3], "tracker.csv", recording.problems);
    for (const TrackedBody& body : recording.info.bodies)
      recording.body_poses.push_back(parse_body_csv(next_file(), body_file(body.name), recording.problems));
  } catch (const Error&) {
    return 0;
  }
  // What was read keeps the rules, and what keeps the rules can be inspected.
  validate_recording(recording);
  InspectConfig config;
  config.quiet_s = 0.02;
  const Inspection inspection = inspect_recording(recording, config);
  must(inspection.probe.lost_share >= 0.0 && inspection.probe.lost_share <= 1.0);
  must(!inspection_json(inspection).empty() && !inspection_text(inspection).empty());
  return 0;
}
