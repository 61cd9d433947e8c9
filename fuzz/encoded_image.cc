#include "asperity/base/error.h"
#include "asperity/image/read_gray_image.h"
#include "fuzz_input.h"

using namespace asperity;

// Our look at the header alone: OpenCV's decoders, behind it, are fuzzed by others.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const auto [width, height] = encoded_image_size({data, size}, "in");
    must(width >= 1 && height >= 1 && width <= kLargestImageSide_px && height <= kLargestImageSide_px);
  } catch (const Error& error) {
    must(std::string_view(error.what()).starts_with("in: "));
  }
  return 0;
}
