// An image is refused with an Error that names it, or has the size that its header says.
#include "asperity/base/error.h"
#include "asperity/image/read_gray_image.h"
#include "fuzz_input.h"

using namespace asperity;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr int kMostPixels = 1 << 22;  // what is larger takes the time of many inputs
  try {
    const auto [width, height] = encoded_image_size({data, size}, "in");
    must(width >= 1 && height >= 1 && width <= kLargestImageSide_px && height <= kLargestImageSide_px);
    if (width * height > kMostPixels) return 0;
    const GrayImage image = decode_gray_image({data, size}, "in");
    must(image.width == width && image.height == height);
    must(image.pixels.size() == static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  } catch (const Error& error) {
    must(std::string_view(error.what()).starts_with("in: "));
  }
  return 0;
}
