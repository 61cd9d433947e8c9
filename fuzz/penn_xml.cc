// A texture of the Penn Haptic Texture Toolkit is refused with an Error, or is a texture: stable filters that
// give numbers, and a file that reads back.
#include <cmath>
#include <cstdint>
#include <string>

#include "asperity/base/error.h"
#include "asperity/texture/evaluate_autoregressive.h"
#include "asperity/texture/import_penn.h"
#include "asperity/texture/texture_file.h"
#include "fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  asperity::Texture texture;
  try {
    texture.model = asperity::parse_penn(asperity::fuzz_text(data, size), "fuzz").texture;
  } catch (const asperity::Error&) {
    return 0;
  }
  const auto& model = std::get<asperity::AutoregressiveTexture>(texture.model);
  asperity::SeriesState state = asperity::start_series(1);
  for (int i = 0; i < 50; ++i) {
    const double speed_mps = 0.01 * i;
    const auto filter = asperity::blended_filter(model, asperity::blend_models(model, speed_mps, 0.1 * i, -1));
    for (const double k : filter.k) asperity::must(std::abs(k) < 1.0);
    asperity::must(std::isfinite(asperity::next_acceleration_mps2(model, state, speed_mps, 0.1 * i, 1e-3)));
  }
  const std::string text = asperity::format_texture(texture);
  asperity::must(asperity::format_texture(asperity::parse_texture(text, "again")) == text);
  return 0;
}
