#include "bvh_oriented_box.h"

#include <cmath>

#include <Eigen/Geometry>

namespace asperity::bvh {

void set_oriented_box(std::span<const std::array<Eigen::Vector3d, 3>> triangles, LeafHead& head) {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero(), middle = normal;
  for (const auto& [a, b, c] : triangles) {
    const Eigen::Vector3d area = (b - a).cross(c - a);
    normal += normal.dot(area) < 0.0 ? Eigen::Vector3d(-area) : area;
    middle += a + b + c;
  }
  middle /= 3.0 * static_cast<double>(triangles.size());
  const double length = normal.norm();
  normal = length > 0.0 ? Eigen::Vector3d(normal / length) : Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d u = normal.unitOrthogonal(), w = normal.cross(u);
  double uu = 0.0, uw = 0.0, ww = 0.0;
  for (const auto& triangle : triangles)
    for (const Eigen::Vector3d& corner : triangle) {
      const double along_u = (corner - middle).dot(u), along_w = (corner - middle).dot(w);
      uu += along_u * along_u;
      uw += along_u * along_w;
      ww += along_w * along_w;
    }
  const double angle = 0.5 * std::atan2(2.0 * uw, uu - ww);
  const Eigen::Vector3d longest = std::cos(angle) * u + std::sin(angle) * w;

  // Rounding lengthens the matrix by less than 2^-22.
  Eigen::Matrix3d axes;
  axes.row(0) = (1.0 - 0x1p-20) * longest;
  axes.row(1) = (1.0 - 0x1p-20) * normal.cross(longest);
  axes.row(2) = (1.0 - 0x1p-20) * normal;
  axes = axes.cast<float>().cast<double>().eval();
  Eigen::Array3d low = Eigen::Array3d::Constant(HUGE_VAL), high = -low;
  for (const auto& triangle : triangles)
    for (const Eigen::Vector3d& corner : triangle) {
      const Eigen::Array3d place = (axes * corner).array();
      low = low.min(place);
      high = high.max(place);
    }
  // Coordinates are below 2^17 units, so rounding to floats and that of the products stays below 2^-6 of one.
  for (int k = 0; k < 3; ++k) {
    for (int j = 0; j < 3; ++j) head.axes[j][k] = static_cast<float>(axes(k, j));
    head.low[k] = static_cast<float>(low[k] - 0x1p-6);
    head.high[k] = static_cast<float>(high[k] + 0x1p-6);
  }
}

}  // namespace asperity::bvh
