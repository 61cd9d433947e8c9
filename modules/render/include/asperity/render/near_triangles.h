#pragma once

#include <array>
#include <cstdint>

#include <Eigen/Core>

namespace asperity {

// A triangle of a model's object, in the scene's world.
struct NearTriangle {
  Eigen::Vector3d a_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d b_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d c_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  // unit; zero for one without area
  std::uint32_t object = 0;
  std::uint32_t triangle = 0;
};

// All triangles of a model that have a point within `radius_m` of `centre_m`. A proxy keeps them from tick to tick,
// for as long as it moves within that ball.
struct NearTriangles {
  static constexpr std::uint32_t kMost = 1024;

  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();
  double radius_m = -1.0;  // negative: nothing was gathered yet
  bool complete = true;    // false: there are more than kMost, and some of them are here
  std::uint32_t count = 0;
  std::array<NearTriangle, kMost> triangles;
};

}  // namespace asperity
