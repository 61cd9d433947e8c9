#include "asperity/base/error.h"
#include "asperity/recording/format_recording.h"
#include "asperity/recording/parse_recording.h"
#include "fuzz_input.h"

using namespace asperity;

namespace {

void read_tracker(std::string_view text) {
  try {
    Problems problems;
    const TrackerStream tracker = parse_tracker_csv(text, "tracker.csv", problems);
    must(tracker.size() > 0 && tracker.T_world_marker.size() == tracker.size());
    for (std::size_t i = 0; i < tracker.size(); ++i) {
      must(i == 0 || tracker.t_ns[i] > tracker.t_ns[i - 1]);
      must(std::abs(tracker.T_world_marker[i].rotation.norm() - 1.0) < 1e-12);
    }
    const std::string written = format_tracker_csv(tracker);
    Problems none;
    must(format_tracker_csv(parse_tracker_csv(written, "again.csv", none)) == written && none.empty());
  } catch (const Error& error) {
    must(std::string_view(error.what()).starts_with("tracker.csv:"));
  }
}

void read_truth(std::string_view text) {
  try {
    Problems problems;
    const std::string written = format_truth_csv(parse_truth_csv(text, "truth.csv", problems));
    Problems none;
    must(format_truth_csv(parse_truth_csv(written, "again.csv", none)) == written && none.empty());
  } catch (const Error& error) {
    must(std::string_view(error.what()).starts_with("truth.csv:"));
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  read_tracker(fuzz_text(data, size));
  read_truth(fuzz_text(data, size));
  return 0;
}
