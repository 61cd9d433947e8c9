#include "asperity/base/error.h"
#include "asperity/recording/format_recording.h"
#include "asperity/recording/parse_recording.h"
#include "fuzz_input.h"

using namespace asperity;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const std::string written = format_recording_info(parse_recording_info(fuzz_text(data, size), "recording.json"));
    must(format_recording_info(parse_recording_info(written, "again.json")) == written);
  } catch (const Error& error) {
    must(std::string_view(error.what()).starts_with("recording.json:"));
  }
  return 0;
}
