#pragma once

#include <array>

#include <Eigen/Core>

namespace asperity {

// A vector split by the normals of touched surfaces: a part that they push (in the cone of the normals) and the rest,
// which is perpendicular to it (Moreau 1962). shares_m[i] >= 0: pushed = sum of shares_m[i] n_i.
struct ConeSplit {
  Eigen::Vector3d pushed_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d rest_m = Eigen::Vector3d::Zero();
  std::array<double, 3> shares_m{};
};

// At most three unit normals.
ConeSplit split_by_cone(const Eigen::Vector3d& v_m, const std::array<Eigen::Vector3d, 3>& normals, int count) noexcept;

// The shortest y with n_i · y = 1 for all normals: one skin's thickness off all of them. No longer than 16, however
// acute the corner that they form.
Eigen::Vector3d off_all(const std::array<Eigen::Vector3d, 3>& normals, int count) noexcept;

}  // namespace asperity
