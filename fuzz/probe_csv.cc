#include "asperity/base/error.h"
#include "asperity/recording/format_recording.h"
#include "asperity/recording/parse_recording.h"
#include "fuzz_input.h"

using namespace asperity;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    Problems problems;
    const ProbeStream probe = parse_probe_csv(fuzz_text(data, size), "probe.csv", problems);
    must(probe.size() > 0 && probe.accel_counts.size() == probe.size() && probe.force_counts.size() == probe.size());
    for (std::size_t i = 0; i < probe.size(); ++i) {
      must(i == 0 || probe.t_ns[i] > probe.t_ns[i - 1]);
      must(probe.accel_counts[i].allFinite());
    }
    const std::string written = format_probe_csv(probe);
    Problems none;
    must(format_probe_csv(parse_probe_csv(written, "again.csv", none)) == written && none.empty());
  } catch (const Error& error) {
    must(std::string_view(error.what()).starts_with("probe.csv:"));
  }
  return 0;
}
