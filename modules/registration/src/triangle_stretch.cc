#include "asperity/registration/triangle_stretch.h"

#include <cmath>

#include <Eigen/Dense>

#include "asperity/geometry/flat_triangle.h"

namespace asperity {

TriangleStretch triangle_stretch(const TriangleMesh& mesh, std::uint32_t triangle, const HapticTriangle& coordinates) {
  const FlatTriangle flat = flatten_triangle(mesh, triangle);
  Eigen::Matrix2d surface;
  surface << flat.corner[1] - flat.corner[0], flat.corner[2] - flat.corner[0];
  const auto& xy_mm = coordinates.xy_mm;
  Eigen::Matrix2d texture;
  texture << xy_mm[1] - xy_mm[0], xy_mm[2] - xy_mm[0];
  const Eigen::Matrix2d map = 1e-3 * texture * surface.inverse();
  TriangleStretch out;
  if (!map.allFinite()) return out;
  // Singular values of a 2 × 2 matrix: half the sum and difference of these two.
  const double sum = std::hypot(map(0, 0) + map(1, 1), map(1, 0) - map(0, 1));
  const double difference = std::hypot(map(0, 0) - map(1, 1), map(1, 0) + map(0, 1));
  out.high = 0.5 * (sum + difference);
  out.low = 0.5 * std::abs(sum - difference);
  out.area_m2 = 0.5 * std::abs(surface.determinant());
  out.folded = map.determinant() >= 0.0;
  out.known = true;
  return out;
}

}  // namespace asperity
