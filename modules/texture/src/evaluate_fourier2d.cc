#include "asperity/texture/evaluate_fourier2d.h"

#include <algorithm>

#include "asperity/texture/evaluate_fourier1d.h"
#include "asperity/texture/evaluate_spline_grid.h"
#include "fourier1d_extremes.h"

namespace asperity {

HeightAndGradient evaluate_height(const Fourier2d& t, double x_m, double y_m) noexcept {
  if (t.kind == Fourier2dKind::kIsotropic) return evaluate_height(t.grid, x_m, y_m);
  const HeightAndSlope x = evaluate_height(t.x, x_m);
  const HeightAndSlope y = evaluate_height(t.y, y_m);
  return {t.offset_m + t.scale_per_m * x.height_m * y.height_m, t.scale_per_m * x.slope * y.height_m,
          t.scale_per_m * x.height_m * y.slope};
}

double lowest_height_m(const Fourier2d& t) {
  if (t.kind == Fourier2dKind::kIsotropic) return lowest_height_m(t.grid);
  // A product is lowest where both factors are extreme.
  const double x[2] = {lowest_height_m(t.x), highest_height_m(t.x)};
  const double y[2] = {lowest_height_m(t.y), highest_height_m(t.y)};
  const auto corner = [&](int i, int j) { return t.scale_per_m * x[i] * y[j]; };
  return t.offset_m + std::min({corner(0, 0), corner(0, 1), corner(1, 0), corner(1, 1)});
}

}  // namespace asperity
