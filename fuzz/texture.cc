// A texture file is refused with an Error, or reads, evaluates to numbers and writes itself back.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "asperity/base/error.h"
#include "asperity/texture/evaluate_fourier1d.h"
#include "asperity/texture/texture_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  asperity::Texture texture;
  try {
    texture = asperity::parse_texture({reinterpret_cast<const char*>(data), size}, "fuzz");
  } catch (const asperity::Error&) {
    return 0;
  }
  if (!std::isfinite(asperity::evaluate(std::get<asperity::Fourier1d>(texture.model), 0.0123).height_m)) std::abort();
  const std::string text = asperity::format_texture(texture);
  if (asperity::format_texture(asperity::parse_texture(text, "again")) != text) std::abort();
  return 0;
}
