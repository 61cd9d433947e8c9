#include "fourier1d_block.h"

#include <cmath>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "model_block.h"

namespace asperity {

Fourier1d read_fourier1d(JsonObject& series) {
  Fourier1d f;
  f.length_mm = series.required("length_mm").number({1e-6, 1e6});
  if (const auto omega = series.optional("omega_rad_per_mm")) {
    const double given = omega->number({0.0, kLargestNumber});
    if (std::abs(given - f.omega_rad_per_mm()) > 1e-4 * f.omega_rad_per_mm())
      omega->fail(number_text(given) + " is not 2π / length_mm = " + number_text(f.omega_rad_per_mm()));
  }
  f.a_m = series.required("a_m").numbers(kMostCoefficients, kHeights_m);
  f.b_m = series.required("b_m").numbers(kMostCoefficients, kHeights_m);
  if (f.a_m.empty()) series.fail("a_m", "is empty");
  if (f.a_m.size() != f.b_m.size()) {
    series.fail("b_m", std::to_string(f.b_m.size()) + " numbers where a_m has " + std::to_string(f.a_m.size()));
  }
  series.read_number("mean_m", f.mean_m, kHeights_m);
  series.finish();
  return f;
}

void check_fourier1d(const Fourier1d& f) {
  if (f.a_m.size() != f.b_m.size() || f.a_m.empty()) {
    throw Error("texture: " + std::to_string(f.a_m.size()) + " cosine and " + std::to_string(f.b_m.size()) +
                " sine coefficients");
  }
}

void TextureModelTraits<Fourier1d>::read_block(const BlockInput& input, Fourier1d& model) {
  model = read_fourier1d(input.block);
}

std::string TextureModelTraits<Fourier1d>::write_block(const Fourier1d& f, BlockOutput&) {
  check_fourier1d(f);
  JsonWriter block = block_writer();
  block.number("length_mm", f.length_mm);
  block.number("omega_rad_per_mm", f.omega_rad_per_mm());
  block.numbers("a_m", f.a_m);
  block.numbers("b_m", f.b_m);
  block.number("mean_m", f.mean_m);
  return block.take();
}

}  // namespace asperity
