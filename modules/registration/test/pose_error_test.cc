#include "asperity/registration/pose_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "asperity/base/error.h"

namespace asperity {
namespace {

using Eigen::Vector3d;

TEST(PoseError, OfAShiftIsItsLength) {
  RegistrationResult result;
  result.T_mesh_world = {exp_rotation({0.3, -0.2, 0.9}), {0.1, 0.2, 0.3}};
  const Pose truth = Pose{Eigen::Quaterniond::Identity(), {3e-3, 0.0, -4e-3}} * result.T_mesh_world;
  result.covariance.bottomRightCorner<3, 3>() = Vector3d(1e-6, 4e-6, 4e-6).asDiagonal();
  const std::vector<Vector3d> points{{0.0, 0.0, 0.0}, {0.05, 0.01, 0.0}};
  const PoseError error = pose_error(result, truth, points);
  EXPECT_NEAR(error.rms_m, 5e-3, 1e-15);
  EXPECT_NEAR(error.rotation_rad, 0.0, 1e-7);  // an angle from a quaternion's rounding
  EXPECT_NEAR(error.sigma_m, 3e-3, 1e-15);
  EXPECT_EQ(error.sigma_rad, 0.0);
}

TEST(PoseError, OfATurnGrowsWithTheDistanceFromItsAxis) {
  RegistrationResult result;
  result.centre_mesh_m = {0.01, 0.0, 0.0};
  result.covariance(2, 2) = 0.02 * 0.02;
  constexpr double kTurn = 1e-3;
  const Pose about_z{exp_rotation({0.0, 0.0, kTurn}), Vector3d::Zero()};
  result.T_mesh_world = about_z;
  const PoseError error = pose_error(result, Pose{}, std::vector<Vector3d>{{0.03, 0.0, 0.5}, {0.0, 0.04, -0.2}});
  // Chords 2 r sin(θ/2) at r = 30 and 40 mm; by the covariance 0.02 rad at 20 and at √1700 mm from the centre.
  EXPECT_NEAR(error.rms_m, 2.0 * std::sin(0.5 * kTurn) * std::sqrt((9e-4 + 16e-4) / 2.0), 1e-12);
  EXPECT_NEAR(error.rotation_rad, kTurn, 1e-12);
  EXPECT_NEAR(error.sigma_m, 0.02 * std::sqrt((4e-4 + 17e-4) / 2.0), 1e-12);
  EXPECT_NEAR(error.sigma_rad, 0.02, 1e-15);
}

TEST(PoseError, NeedsAPoint) { EXPECT_THROW(pose_error({}, {}, {}), Error); }

}  // namespace
}  // namespace asperity
