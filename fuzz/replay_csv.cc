// A path that was read can be replayed, and every reading of it is finite.
#include "asperity/base/error.h"
#include "asperity/device/read_replay_csv.h"
#include "fuzz_input.h"

using namespace asperity;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  ReplayFile file;
  try {
    file = parse_replay_csv(fuzz_text(data, size), "fuzz");
  } catch (const Error&) {
    return 0;
  }
  must(!file.samples.empty());
  const std::int64_t duration_ns = file.samples.back().t_ns - file.samples.front().t_ns;
  const auto device = open_replay(file.samples);
  for (const std::int64_t t_ns : {std::int64_t{0}, duration_ns / 3, duration_ns / 2, duration_ns, duration_ns + 1}) {
    const DeviceReading reading = device->read(t_ns);
    must(reading.p_m.allFinite() && reading.v_mps.allFinite());
  }
  must(device->read(duration_ns + 1).status == DeviceStatus::kEnded);
  return 0;
}
