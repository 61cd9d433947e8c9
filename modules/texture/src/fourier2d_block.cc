#include <string>

#include "asperity/base/error.h"
#include "asperity/texture/synthesize_isotropic.h"
#include "block_json.h"
#include "fourier1d_block.h"
#include "model_block.h"

namespace asperity {
namespace {

constexpr std::int64_t kLargestSeed = 9007199254740992;  // 2^53: what every JSON reader keeps

std::string series_json(const Fourier1d& f) {
  check_fourier1d(f);
  return "{\"length_mm\": " + number_json(f.length_mm, "length_mm") + ", \"a_m\": " + numbers_json(f.a_m, "a_m") +
         ", \"b_m\": " + numbers_json(f.b_m, "b_m") + ", \"mean_m\": " + number_json(f.mean_m, "mean_m") + "}";
}

}  // namespace

void TextureModelTraits<Fourier2d>::read_block(const BlockInput& input, Fourier2d& t) {
  const LocatedJson& json = input.json;
  const std::string& path = input.path;
  t.kind = static_cast<Fourier2dKind>(
      required_choice(json, path, "kind", {kFourier2dKindNames.begin(), kFourier2dKindNames.end()}));
  if (t.kind != Fourier2dKind::kIsotropic) {
    json.only(path, {"kind", "x", "y", "scale_per_m", "offset_m"});
    json.require(path, "x");
    json.require(path, "y");
    t.x = read_fourier1d(json, path + ".x");
    t.y = read_fourier1d(json, path + ".y");
    t.scale_per_m = required_number(json, path, "scale_per_m", -1e15, 1e15);
    t.offset_m = required_number(json, path, "offset_m", -kLargestHeight_m, kLargestHeight_m);
    return;
  }
  json.only(path, {"kind", "length_mm", "power_m2", "mean_m", "seed"});
  t.isotropic.length_mm = required_number(json, path, "length_mm", 1e-6, 1e6);
  t.isotropic.power_m2 = required_numbers(json, path, "power_m2", kLargestHeight_m, kMostIsotropicHarmonics);
  t.isotropic.mean_m = required_number(json, path, "mean_m", -kLargestHeight_m, kLargestHeight_m);
  t.isotropic.seed = required_integer(json, path, "seed", 0, kLargestSeed);
  if (t.isotropic.power_m2.empty()) json.fail(path + ".power_m2", "is empty");
  for (std::size_t j = 0; j < t.isotropic.power_m2.size(); ++j) {
    if (t.isotropic.power_m2[j] < 0.0) json.fail(path + ".power_m2[" + std::to_string(j) + "]", "is negative");
  }
  t.grid = synthesize_isotropic(t.isotropic);
}

std::string TextureModelTraits<Fourier2d>::write_block(const Fourier2d& t, BlockOutput&) {
  BlockText block;
  block.add("kind", "\"" + std::string(kFourier2dKindNames.at(static_cast<std::size_t>(t.kind))) + "\"");
  if (t.kind != Fourier2dKind::kIsotropic) {
    block.add("x", series_json(t.x)).add("y", series_json(t.y));
    return block.add("scale_per_m", t.scale_per_m).add("offset_m", t.offset_m).str();
  }
  if (t.isotropic.seed < 0 || t.isotropic.seed > kLargestSeed)
    throw Error("texture: the seed " + std::to_string(t.isotropic.seed) + " is not within 0 and 2^53");
  return block.add("length_mm", t.isotropic.length_mm)
      .add("power_m2", t.isotropic.power_m2)
      .add("mean_m", t.isotropic.mean_m)
      .add("seed", std::to_string(t.isotropic.seed))
      .str();
}

}  // namespace asperity
