#include "asperity/registration/manual_alignment.h"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "asperity/base/error.h"

namespace asperity {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

}  // namespace

Pose align_manually(const ManualAlignment& alignment) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (!std::isfinite(alignment.shift_m[k]) || !std::isfinite(alignment.rotation_deg[k])) {
      throw Error(fmt::format("manual alignment: axis {}: shift {} m or rotation {} deg is not finite", "xyz"[k],
                              alignment.shift_m[k], alignment.rotation_deg[k]));
    }
  }
  Pose out;
  for (int k = 0; k < 3; ++k) {
    const double rotation_rad = kDegree * std::remainder(alignment.rotation_deg[static_cast<std::size_t>(k)], 360.0);
    out.rotation = out.rotation * Eigen::AngleAxisd(rotation_rad, Eigen::Vector3d::Unit(k));
  }
  out.translation_m = Eigen::Vector3d(alignment.shift_m[0], alignment.shift_m[1], alignment.shift_m[2]);
  return out;
}

ManualAlignment manual_alignment(const Pose& T_mesh_world) {
  // Rx(a) Ry(b) Rz(c) has the first row (cos b cos c, -cos b sin c, sin b) and the last column
  // (sin b, -sin a cos b, cos a cos b).
  const Eigen::Matrix3d r = T_mesh_world.rotation.normalized().toRotationMatrix();
  const double cos_b = std::hypot(r(0, 0), r(0, 1));
  ManualAlignment out;
  out.shift_m = {T_mesh_world.translation_m.x(), T_mesh_world.translation_m.y(), T_mesh_world.translation_m.z()};
  out.rotation_deg[1] = std::atan2(r(0, 2), cos_b) / kDegree;
  if (cos_b > 1e-9) {  // of 1: the rotations about x and z are apart
    out.rotation_deg[0] = std::atan2(-r(1, 2), r(2, 2)) / kDegree;
    out.rotation_deg[2] = std::atan2(-r(0, 1), r(0, 0)) / kDegree;
  } else {
    out.rotation_deg[0] = std::atan2(r(2, 1), r(1, 1)) / kDegree;
  }
  return out;
}

AbsoluteOrientation align_picked(std::span<const Eigen::Vector3d> p_world_m,
                                 std::span<const Eigen::Vector3d> p_mesh_m) {
  AbsoluteOrientation out = absolute_orientation(p_world_m, p_mesh_m);
  if (out.collinear)
    throw Error(
        "picked points: they are on one line, so that the rotation about it is not determined; pick a further point "
        "off the line");
  return out;
}

}  // namespace asperity
