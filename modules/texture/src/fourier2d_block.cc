#include <string>

#include "asperity/base/error.h"
#include "asperity/texture/synthesize_isotropic.h"
#include "fourier1d_block.h"
#include "model_block.h"

namespace asperity {
namespace {

constexpr std::int64_t kLargestSeed = 9007199254740992;  // 2^53: what every JSON reader keeps

void write_series(JsonWriter& block, std::string_view key, const Fourier1d& f) {
  check_fourier1d(f);
  block.begin_inline(key);
  block.number("length_mm", f.length_mm);
  block.numbers("a_m", f.a_m);
  block.numbers("b_m", f.b_m);
  block.number("mean_m", f.mean_m);
  block.end_object();
}

Fourier1d read_series(JsonObject& block, std::string_view key) {
  JsonObject series = block.required_object(key);
  return read_fourier1d(series);
}

}  // namespace

void TextureModelTraits<Fourier2d>::read_block(const BlockInput& input, Fourier2d& t) {
  JsonObject& block = input.block;
  t.kind = static_cast<Fourier2dKind>(block.required("kind").choice(kFourier2dKindNames));
  if (t.kind != Fourier2dKind::kIsotropic) {
    t.x = read_series(block, "x");
    t.y = read_series(block, "y");
    t.scale_per_m = block.required("scale_per_m").number({-1e15, 1e15});
    t.offset_m = block.required("offset_m").number(kHeights_m);
    block.finish();
    return;
  }
  t.isotropic.length_mm = block.required("length_mm").number({1e-6, 1e6});
  const JsonItem power = block.required("power_m2");
  t.isotropic.power_m2 = power.numbers(kMostIsotropicHarmonics, kHeights_m);
  t.isotropic.mean_m = block.required("mean_m").number(kHeights_m);
  t.isotropic.seed = block.required("seed").integer(0, kLargestSeed);
  block.finish();
  if (t.isotropic.power_m2.empty()) power.fail("is empty");
  for (std::size_t j = 0; j < t.isotropic.power_m2.size(); ++j) {
    if (t.isotropic.power_m2[j] < 0.0) power.element(j).fail("is negative");
  }
  t.grid = synthesize_isotropic(t.isotropic);
}

std::string TextureModelTraits<Fourier2d>::write_block(const Fourier2d& t, BlockOutput&) {
  JsonWriter block = block_writer();
  block.text("kind", kFourier2dKindNames.at(static_cast<std::size_t>(t.kind)));
  if (t.kind != Fourier2dKind::kIsotropic) {
    write_series(block, "x", t.x);
    write_series(block, "y", t.y);
    block.number("scale_per_m", t.scale_per_m);
    block.number("offset_m", t.offset_m);
    return block.take();
  }
  if (t.isotropic.seed < 0 || t.isotropic.seed > kLargestSeed)
    throw Error("texture: the seed " + std::to_string(t.isotropic.seed) + " is not within 0 and 2^53");
  block.number("length_mm", t.isotropic.length_mm);
  block.numbers("power_m2", t.isotropic.power_m2);
  block.number("mean_m", t.isotropic.mean_m);
  block.integer("seed", t.isotropic.seed);
  return block.take();
}

}  // namespace asperity
