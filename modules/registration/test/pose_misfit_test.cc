#include "asperity/registration/pose_misfit.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

namespace asperity {
namespace {

using Eigen::Vector3d;

// A flat square of 100 mm, z = 0.
TriangleMesh square() {
  TriangleMesh mesh;
  mesh.vertices_m = {{-0.05, -0.05, 0.0}, {0.05, -0.05, 0.0}, {0.05, 0.05, 0.0}, {-0.05, 0.05, 0.0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

// 60 mm along x at a height of `slow_m` with a relief of 1 mm waves.
MeasuredPath path_at(double slow_m, double relief_m, double covariance_m2) {
  MeasuredPath out;
  for (int i = 0; i <= 600; ++i) {
    const double x_m = -0.03 + 1e-4 * i;
    out.p_world_m.emplace_back(x_m, 1e-3, slow_m + relief_m * std::sin(2.0 * std::numbers::pi * 1e3 * x_m));
  }
  out.slow_covariance_world_m2 = covariance_m2 * Eigen::Matrix3d::Identity();
  return out;
}

PoseMisfit misfit_of(const MeasuredPath& path, const std::optional<Pose>& guess = {}) {
  static const TriangleMesh mesh = square();
  static const MeshBvh bvh(mesh);
  const RegistrationSurface surface = prepare_surface(mesh, bvh);
  return measure_pose_misfit({&path, 1}, surface, guess, {}, {});
}

TEST(PoseMisfit, PartsTheDistancesIntoSlowOnesAndRelief) {
  const PoseMisfit misfit = misfit_of(path_at(1e-3, 1e-4, 4e-10));
  EXPECT_NEAR(misfit.slow_m, 1e-3, 5e-6);
  EXPECT_NEAR(misfit.relief_m, 1e-4 / std::sqrt(2.0), 1e-6);
  // The tracker's slow error, the relief's mean and the mesh's 2 µm; a square has no sag.
  EXPECT_NEAR(misfit.explained_m, std::sqrt(4e-10 + 0.5e-8 + 4e-12), 1e-6);
  EXPECT_NEAR(misfit.extent_m, 0.06 / std::sqrt(12.0), 1e-4);
  EXPECT_TRUE(std::isnan(misfit.guess_shift_m));
}

TEST(PoseMisfit, PointsBeyondTheBorderDoNotCount) {
  MeasuredPath path = path_at(0.0, 1e-5, 0.0);
  for (int i = 0; i < 100; ++i) path.p_world_m.emplace_back(0.06 + 1e-4 * i, 1e-3, 0.02);
  EXPECT_LT(misfit_of(path).slow_m, 2e-6);
}

// A third of the path rises to 20 mm over the square, 20 mm from its beginning on.
TEST(PoseMisfit, APartInTheAirIsOff) {
  MeasuredPath path = path_at(0.0, 1e-5, 0.0);
  EXPECT_EQ(misfit_of(path).off_share, 0.0);
  for (int i = 0; i < 300; ++i) path.p_world_m.emplace_back(0.02, -0.03 + 1e-4 * i, 0.02);
  const PoseMisfit misfit = misfit_of(path);
  EXPECT_NEAR(misfit.off_share, 300.0 / 901.0, 0.12);  // to half of the 20 mm over which distances are averaged
  EXPECT_NEAR(misfit.off_m, 0.02, 0.3e-3);
  EXPECT_LT(misfit.off_limit_m, 2e-3);
}

// Holes of a board are deep, but no centimetre is off.
TEST(PoseMisfit, AReliefIsNotOff) {
  MeasuredPath path = path_at(0.0, 0.0, 0.0);
  for (std::size_t i = 0; i < path.p_world_m.size(); ++i) {
    if (i % 20 < 6) path.p_world_m[i].z() = -1.5e-3;
  }
  EXPECT_EQ(misfit_of(path).off_share, 0.0);
}

TEST(PoseMisfit, MeasuresFromTheGuess) {
  const Pose guess{Eigen::Quaterniond(Eigen::AngleAxisd(0.2, Vector3d::UnitZ())), Vector3d(0.0, 0.0, 3e-3)};
  const PoseMisfit misfit = misfit_of(path_at(0.0, 0.0, 0.0), guess);
  // The mean of the points is at (0, 1 mm, 0), which a turn by 0.2 moves by 0.2 mm.
  EXPECT_NEAR(misfit.guess_shift_m, std::hypot(3e-3, 2e-3 * std::sin(0.1)), 1e-6);
  EXPECT_NEAR(misfit.guess_rotation_rad, 0.2, 1e-9);
  EXPECT_EQ(misfit.guess_sigma_m, PoseMisfitConfig{}.guess_sigma_m);
}

TEST(PoseMisfit, TooFewPointsSayNothing) {
  MeasuredPath path;
  path.p_world_m = {{0.0, 0.0, 0.0}, {0.01, 0.0, 0.0}, {0.0, 0.01, 0.0}};
  EXPECT_TRUE(std::isnan(misfit_of(path).slow_m));
}

}  // namespace
}  // namespace asperity
