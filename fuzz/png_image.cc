// An image is refused with an Error, or reads and writes itself back.
#include <cstdint>

#include "asperity/base/error.h"
#include "asperity/image/png_image.h"
#include "fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  asperity::DeepGrayImage image;
  try {
    image = asperity::parse_png(asperity::fuzz_text(data, size), "fuzz");
  } catch (const asperity::Error&) {
    return 0;
  }
  asperity::must(asperity::parse_png(asperity::format_png(image), "again").pixels == image.pixels);
  return 0;
}
