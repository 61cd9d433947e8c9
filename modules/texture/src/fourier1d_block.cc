#include "fourier1d_block.h"

#include <cmath>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "block_json.h"
#include "model_block.h"

namespace asperity {

Fourier1d read_fourier1d(const LocatedJson& json, const std::string& path) {
  json.only(path, {"length_mm", "omega_rad_per_mm", "a_m", "b_m", "mean_m"});
  Fourier1d f;
  f.length_mm = required_number(json, path, "length_mm", 1e-6, 1e6);
  if (const auto* omega = json.find(path, "omega_rad_per_mm")) {
    const double given = read_number(json, *omega, path + ".omega_rad_per_mm", 0.0, kLargestNumber);
    if (std::abs(given - f.omega_rad_per_mm()) > 1e-4 * f.omega_rad_per_mm()) {
      json.fail(path + ".omega_rad_per_mm",
                number_text(given) + " is not 2π / length_mm = " + number_text(f.omega_rad_per_mm()));
    }
  }
  f.a_m = required_numbers(json, path, "a_m", kLargestHeight_m);
  f.b_m = required_numbers(json, path, "b_m", kLargestHeight_m);
  if (f.a_m.empty()) json.fail(path + ".a_m", "is empty");
  if (f.a_m.size() != f.b_m.size()) {
    json.fail(path + ".b_m", std::to_string(f.b_m.size()) + " numbers where a_m has " + std::to_string(f.a_m.size()));
  }
  f.mean_m = optional_number(json, path, "mean_m", -kLargestHeight_m, kLargestHeight_m, 0.0);
  return f;
}

void check_fourier1d(const Fourier1d& f) {
  if (f.a_m.size() != f.b_m.size() || f.a_m.empty()) {
    throw Error("texture: " + std::to_string(f.a_m.size()) + " cosine and " + std::to_string(f.b_m.size()) +
                " sine coefficients");
  }
}

void TextureModelTraits<Fourier1d>::read_block(const BlockInput& input, Fourier1d& model) {
  model = read_fourier1d(input.json, input.path);
}

std::string TextureModelTraits<Fourier1d>::write_block(const Fourier1d& f, BlockOutput&) {
  check_fourier1d(f);
  return BlockText()
      .add("length_mm", f.length_mm)
      .add("omega_rad_per_mm", f.omega_rad_per_mm())
      .add("a_m", f.a_m)
      .add("b_m", f.b_m)
      .add("mean_m", f.mean_m)
      .str();
}

}  // namespace asperity
