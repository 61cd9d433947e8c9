// A TIFF is refused with an Error, or reads to as many finite or missing numbers as it has pixels.
#include <cmath>

#include "asperity/base/error.h"
#include "asperity/image/tiff_image.h"
#include "fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  asperity::TiffImage image;
  try {
    image = asperity::parse_tiff(asperity::fuzz_text(data, size), "fuzz");
  } catch (const asperity::Error&) {
    return 0;
  }
  asperity::must(image.columns > 0 && image.rows > 0 && image.values.size() == image.columns * image.rows);
  for (const double value : image.values) asperity::must(!std::isinf(value));
  return 0;
}
