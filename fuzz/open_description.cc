// A description is refused, or has figures in their ranges and, written and read again, is the same.
#include "asperity/base/error.h"
#include "asperity/link/open_protocol.h"
#include "fuzz_input.h"

using namespace asperity;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto description = parse_open_description(fuzz_text(data, size));
  if (!description) return 0;
  must(description->rate_Hz >= 0.0 && description->rate_Hz <= 1e5);
  must(description->force_axes == 1 || description->force_axes == 3);
  must(description->name.size() <= kOpenMaxName_bytes && description->firmware.size() <= kOpenMaxName_bytes);
  must(description->adc_min <= description->adc_max);
  const std::string written = format_open_description(*description);
  const auto again = parse_open_description(written);
  // Escaping may make a description too long to be sent, nothing else.
  must(again.has_value() || written.size() > kOpenMaxDescription_bytes);
  must(!again || format_open_description(*again) == written);
  return 0;
}
