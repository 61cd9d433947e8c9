#include "asperity/base/error.h"
#include "asperity/recording/format_recording.h"
#include "asperity/recording/parse_recording.h"
#include "fuzz_input.h"

using namespace asperity;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const Calibration calibration = parse_calibration(fuzz_text(data, size), "calibration.json");
    const std::string written = format_calibration(calibration);
    must(format_calibration(parse_calibration(written, "again.json")) == written);
    // Every calibration that is read can be used.
    must(!calibration.accelerometer.specific_force_mps2({100.0, -200.0, 3e4}).hasNaN());
  } catch (const Error& error) {
    must(std::string_view(error.what()).starts_with("calibration.json:"));
  }
  return 0;
}
