#include "touch_frame.h"

#include <Eigen/Geometry>

#include "project_on_planes.h"

namespace asperity {

using Eigen::Vector3d;

ConeSplit split_by_cone(const Vector3d& v_m, const std::array<Vector3d, 3>& normals, int count) noexcept {
  ConeSplit out;
  if (count == 1) {
    const double along_m = normals[0].dot(v_m);
    out.shares_m[0] = along_m > 0.0 ? along_m : 0.0;
    out.pushed_m = out.shares_m[0] * normals[0];
    out.rest_m = v_m - out.pushed_m;
    return out;
  }
  // The rest is the point nearest to v of the polar cone, n_i · x <= 0.
  PlaneProjection projection(v_m);
  for (int round = 0; round < 12; ++round) {
    int worst = -1;
    double worst_m = 0x1p-44 * v_m.norm();
    for (int i = 0; i < count; ++i) {
      const double out_m = normals[static_cast<std::size_t>(i)].dot(projection.x_m());
      if (out_m > worst_m) worst = i, worst_m = out_m;
    }
    if (worst < 0 || !projection.add({-normals[static_cast<std::size_t>(worst)], 0.0}, worst)) break;
  }
  for (int k = 0; k < projection.size(); ++k) {
    const auto& active = projection.active(k);
    out.shares_m[static_cast<std::size_t>(active.tag)] = active.multiplier_m;
    out.pushed_m -= active.multiplier_m * active.plane.normal;
  }
  out.rest_m = v_m - out.pushed_m;
  return out;
}

Vector3d off_all(const std::array<Vector3d, 3>& normals, int count) noexcept {
  constexpr double kLongest = 16.0;
  Vector3d y = Vector3d::Zero();
  if (count == 1) {
    y = normals[0];
  } else if (count == 2) {
    const Vector3d sum = normals[0] + normals[1];  // n_i · sum = 1 + n_0 · n_1
    y = sum * (2.0 / sum.squaredNorm());
  } else if (count == 3) {
    const Vector3d m = normals[0].cross(normals[1]);
    y = (m + normals[1].cross(normals[2]) + normals[2].cross(normals[0])) / m.dot(normals[2]);
  }
  const double length = y.norm();
  if (!(length <= kLongest)) y = y.allFinite() ? Vector3d(y * (kLongest / length)) : normals[0];
  return y;
}

}  // namespace asperity
