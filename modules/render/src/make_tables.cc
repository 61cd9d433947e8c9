#include "make_tables.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <variant>

#include "asperity/texture/evaluate_fourier1d.h"

namespace asperity {
namespace {

// Of RMS, as promised.
constexpr double kHeightError = 1e-6;
constexpr double kSlopeError = 1e-4;

// What bounds and measures a series: the means are over a period.
struct Size {
  double mean = 0.0;
  double rms_m = 0.0;  // about the mean
  double rms_slope = 0.0;
  double most_m = 0.0;      // bounds |g|
  double most_slope = 0.0;  // bounds |g'|
};

Size size_of(const Fourier1d& f) {
  Size size;
  const double omega_per_m = 2.0 * std::numbers::pi / (1e-3 * f.length_mm);
  double power = 0.0;
  double slope_power = 0.0;
  size.mean = f.mean_m;
  size.most_m = std::abs(f.mean_m);
  for (std::size_t j = 0; j < f.a_m.size(); ++j) {
    const double k = omega_per_m * static_cast<double>(j + 1);
    const double amplitude = std::hypot(f.a_m[j], f.b_m[j]);
    power += 0.5 * amplitude * amplitude;
    slope_power += 0.5 * k * amplitude * k * amplitude;
    size.most_m += amplitude;
    size.most_slope += k * amplitude;
  }
  size.rms_m = std::sqrt(power);
  size.rms_slope = std::sqrt(slope_power);
  return size;
}

GridScale scale_of(const SplineGrid& grid) {
  return {1.0 / grid.spacing_x_m, 1.0 / grid.spacing_y_m, grid.origin_x_m, grid.origin_y_m, 1.0, 0.0};
}

GridScale scale_of(const HeightMap& map) {
  return {1e3 / map.mm_per_px_x, 1e3 / map.mm_per_px_y, 0.0, 0.0, map.metres_per_level(), map.low_m};
}

void make_tables(const HeightMap& map, RenderTexture& texture) { texture.grid = scale_of(map); }
void make_tables(const ArealTexture& areal, RenderTexture& texture) { texture.grid = scale_of(areal.surface); }

void make_tables(const Fourier1d& f, RenderTexture& texture) {
  const Size size = size_of(f);
  texture.x_table = make_periodic_table(f, kHeightError * size.rms_m, kSlopeError * size.rms_slope);
}

// With x = X + ex and y = Y + ey, the product errs by |X| ey + |Y| ex, its slope along x by |X'| ey + |Y| ex'.
// Each of the two terms gets half.
void make_tables(const Fourier2d& f, RenderTexture& texture) {
  if (f.kind == Fourier2dKind::kIsotropic) {
    texture.grid = scale_of(f.grid);
    return;
  }
  const Size x = size_of(f.x);
  const Size y = size_of(f.y);
  const double mean_square_x = x.mean * x.mean + x.rms_m * x.rms_m;
  const double mean_square_y = y.mean * y.mean + y.rms_m * y.rms_m;
  // Of X Y about its mean, and of its slopes.
  const double rms = std::sqrt(mean_square_x * mean_square_y - x.mean * x.mean * y.mean * y.mean);
  const double rms_slope_x = x.rms_slope * std::sqrt(mean_square_y);
  const double rms_slope_y = y.rms_slope * std::sqrt(mean_square_x);
  const auto share = [](double error, double most) {
    return most > 0.0 ? 0.5 * error / most : std::numeric_limits<double>::infinity();
  };
  const auto table = [&](const Fourier1d& g, const Size& other, double own_slope, double other_slope) {
    const double height =
        std::min(share(kHeightError * rms, other.most_m), share(kSlopeError * other_slope, other.most_slope));
    return make_periodic_table(g, height, share(kSlopeError * own_slope, other.most_m));
  };
  texture.x_table = table(f.x, y, rms_slope_x, rms_slope_y);
  texture.y_table = table(f.y, x, rms_slope_y, rms_slope_x);
  if (texture.x_table.cells.empty() || texture.y_table.cells.empty()) texture.x_table = texture.y_table = {};
}

}  // namespace

void make_tables(RenderTexture& texture) {
  std::visit(
      [&]<class Model>(const Model& model) {
        if constexpr (requires { make_tables(model, texture); }) make_tables(model, texture);
      },
      texture.texture.model);
}

}  // namespace asperity
