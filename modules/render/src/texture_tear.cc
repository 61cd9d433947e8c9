#include "texture_tear.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

#include "asperity/texture/evaluate_height.h"

namespace asperity {
namespace {

using Eigen::Vector2d;

constexpr double kOfTheEdge = 1e-4;
constexpr double kOfTheCoordinates = 1e-6;

// After how much of x and of y heights are the same again; infinite: never, 0: they are the same everywhere.
Vector2d periods_m(const TextureModel& model) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  if (const auto* f = std::get_if<Fourier1d>(&model)) return {1e-3 * f->length_mm, 0.0};
  if (const auto* f = std::get_if<Fourier2d>(&model)) {
    if (f->kind == Fourier2dKind::kIsotropic) return Vector2d::Constant(1e-3 * f->isotropic.length_mm);
    return 1e-3 * Vector2d(f->x.length_mm, f->y.length_mm);
  }
  if (const auto* map = std::get_if<HeightMap>(&model); map != nullptr && map->border == Border::kPeriodic)
    return 1e-3 * Vector2d(static_cast<double>(map->columns) * map->mm_per_px_x,
                           static_cast<double>(map->rows) * map->mm_per_px_y);
  if (const auto* areal = std::get_if<ArealTexture>(&model);
      areal != nullptr && areal->surface.border == Border::kPeriodic)
    return {static_cast<double>(areal->surface.columns) * areal->surface.spacing_x_m,
            static_cast<double>(areal->surface.rows) * areal->surface.spacing_y_m};
  return Vector2d::Constant(kNever);
}

}  // namespace

bool is_torn(const RenderTexture& texture, const std::array<Vector2d, 2>& a_m, const std::array<Vector2d, 2>& b_m) {
  if (!is_height_field(texture.texture.model) || texture.model == TextureForceModel::kStochastic) return false;
  const Vector2d period_m = periods_m(texture.texture.model);
  const double edge_m = std::max((a_m[1] - a_m[0]).norm(), (b_m[1] - b_m[0]).norm());
  for (Eigen::Index axis = 0; axis < 2; ++axis) {
    if (period_m[axis] == 0.0) continue;
    const double first_m = b_m[0][axis] - a_m[0][axis];
    const double whole_m = std::isfinite(period_m[axis]) ? period_m[axis] * std::round(first_m / period_m[axis]) : 0.0;
    for (std::size_t end = 0; end < 2; ++end) {
      const double size_m = std::max(std::abs(a_m[end][axis]), std::abs(b_m[end][axis]));
      if (std::abs(b_m[end][axis] - a_m[end][axis] - whole_m) > kOfTheEdge * edge_m + kOfTheCoordinates * size_m)
        return true;
    }
  }
  return false;
}

}  // namespace asperity
