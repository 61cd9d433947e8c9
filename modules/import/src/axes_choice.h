#pragma once

#include <array>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace asperity {

// Axes exchanged and mirrored: component i is `sign[i]` times component `axis[i]` of what was read.
struct AxesChoice {
  std::array<int, 3> axis;
  std::array<int, 3> sign;
  Eigen::Matrix3d R;

  std::string name() const;  // "y,-x,z"
};

// The 24 rotations that exchange axes (determinant 1), or their 24 mirror images (−1).
std::vector<AxesChoice> all_axes(double determinant);

// "y,-x,z" where the matrix exchanges axes, else the quaternion of the rotation.
std::string axes_text(const Eigen::Matrix3d& R);

}  // namespace asperity
