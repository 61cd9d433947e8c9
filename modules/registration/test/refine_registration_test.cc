#include "asperity/registration/refine_registration.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include "asperity/base/random.h"
#include "asperity/registration/register_path.h"

namespace asperity {
namespace {

using Eigen::Vector3d;
using Vector6 = Eigen::Matrix<double, 6, 1>;

const Pose kMeshFromWorld{Eigen::Quaterniond(Eigen::AngleAxisd(0.4, Vector3d(1, -2, 1).normalized())),
                          Vector3d(0.05, 0.02, -0.3)};
constexpr double kSpacing_m = 0.25e-3;

// A bumpy ball of 40 mm radius, facets of some 1.5 mm.
TriangleMesh ball() {
  constexpr int kRows = 80, kColumns = 160;
  TriangleMesh mesh;
  for (int row = 0; row <= kRows; ++row) {
    const double latitude = std::numbers::pi * (static_cast<double>(row) / kRows - 0.5);
    for (int column = 0; column < kColumns; ++column) {
      const double longitude = 2.0 * std::numbers::pi * column / kColumns;
      const Vector3d out(std::cos(latitude) * std::cos(longitude), std::cos(latitude) * std::sin(longitude),
                         std::sin(latitude));
      const double bump = std::sin(7.0 * out.x() + 1.0) * std::sin(6.0 * out.y()) * std::cos(5.0 * out.z() - 0.5);
      mesh.vertices_m.emplace_back(0.04 * (1.0 + 0.06 * bump) * out);
    }
  }
  for (std::uint32_t row = 0; row < kRows; ++row) {
    for (std::uint32_t column = 0; column < kColumns; ++column) {
      const std::uint32_t a = row * kColumns + column, b = row * kColumns + (column + 1) % kColumns;
      mesh.triangles.push_back({a, b, b + kColumns});
      mesh.triangles.push_back({a, b + kColumns, a + kColumns});
    }
  }
  return mesh;
}

struct Draw {
  double white_m = 0.0;  // of each point, along the normal
  double slow_m = 0.0;   // of each axis, lasting for 20 mm
};

// A winding path round the ball with errors, world frame.
MeasuredPath scan(const MeshSurface& surface, const Draw& draw, std::uint64_t seed) {
  Random random(seed);
  MeasuredPath path;
  path.sigma_m = draw.slow_m;
  path.slow_covariance_world_m2 = draw.slow_m * draw.slow_m * Eigen::Matrix3d::Identity();
  const Pose T_world_mesh = kMeshFromWorld.inverse();
  const double keep = std::exp(-kSpacing_m / 20e-3);
  Vector3d slow_m = draw.slow_m * Vector3d(random.normal(), random.normal(), random.normal());
  Vector3d before = Vector3d::Zero();
  for (int i = 0; i < 200000 && path.p_world_m.size() < 600; ++i) {
    const double angle = 1e-4 * i;
    const Vector3d towards(std::cos(angle), std::sin(angle), 0.5 * std::sin(3.0 * angle));
    const RayHit hit = surface.bvh.cast_ray(0.1 * towards.normalized(), -towards.normalized());
    const Vector3d p_m = 0.1 * towards.normalized() - hit.t * towards.normalized();
    if (i > 0 && (p_m - before).norm() < kSpacing_m) continue;
    before = p_m;
    slow_m = keep * slow_m +
             std::sqrt(1.0 - keep * keep) * draw.slow_m * Vector3d(random.normal(), random.normal(), random.normal());
    path.p_world_m.push_back(T_world_mesh * Vector3d(p_m + draw.white_m * random.normal() * towards.normalized()) +
                             slow_m);
  }
  return path;
}

// Turn and shift about `centre_m` from the true pose to another.
Vector6 error_of(const Pose& pose, const Vector3d& centre_m) {
  const Eigen::Quaterniond turn = pose.rotation * kMeshFromWorld.rotation.conjugate();
  Vector6 out;
  out << log_rotation(turn), pose.translation_m - centre_m - turn * (kMeshFromWorld.translation_m - centre_m);
  return out;
}

struct Fits {
  RegistrationResult start, refined;
};
Fits fit(const MeshSurface& surface, const MeasuredPath& path) {
  const RegistrationSurface ready = prepare_surface(surface.mesh, surface.bvh);
  const std::vector<MeasuredPath> paths{path};
  Fits out;
  out.start = register_path(paths, ready, kMeshFromWorld, {});
  out.refined = refine_registration(paths, surface, out.start, {}, {}, {}).registration;
  return out;
}

TEST(RefineRegistration, ItsCovarianceHoldsUnderSlowErrors) {
  const MeshSurface surface(ball());
  constexpr int kTrials = 12;
  double squares = 0.0, start_squares = 0.0, refined_m2 = 0.0, start_m2 = 0.0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const Fits fits = fit(surface, scan(surface, {20e-6, 0.1e-3}, 100 + static_cast<std::uint64_t>(trial)));
    const Vector6 refined = error_of(fits.refined.T_mesh_world, fits.start.centre_mesh_m);
    const Vector6 start = error_of(fits.start.T_mesh_world, fits.start.centre_mesh_m);
    squares += refined.dot(fits.refined.covariance.ldlt().solve(refined)) / kTrials;
    start_squares += start.dot(fits.start.covariance.ldlt().solve(start)) / kTrials;
    refined_m2 += refined.tail<3>().squaredNorm() / kTrials;
    start_m2 += start.tail<3>().squaredNorm() / kTrials;
  }
  // The squared error in standard deviations has the mean 6 and, over 12 trials, the deviation 1. The facets'
  // kinks are not linear in the pose: up to twice that is allowed.
  EXPECT_GT(squares, 2.0);
  EXPECT_LT(squares, 12.0);
  EXPECT_GT(start_squares, 3.0 * squares);  // white noise is not what these errors are
  EXPECT_LT(refined_m2, 1.1 * start_m2);
}

TEST(RefineRegistration, WithWhiteNoiseItAgreesWithTheStart) {
  const MeshSurface surface(ball());
  MeasuredPath path = scan(surface, {50e-6, 0.0}, 5);
  const Fits fits = fit(surface, path);
  const Vector6 refined = error_of(fits.refined.T_mesh_world, fits.start.centre_mesh_m);
  EXPECT_LT(refined.tail<3>().norm(), 30e-6);  // 50 µm over some 600 points and 6 numbers: about 10 µm
  EXPECT_LT(refined.head<3>().norm(), 1e-3);
  EXPECT_TRUE(fits.refined.undetermined.empty());
}

TEST(RefineRegistration, FewPointsGiveTheStartBack) {
  const MeshSurface surface(ball());
  MeasuredPath path = scan(surface, {50e-6, 0.0}, 6);
  path.p_world_m.resize(20);
  const Fits fits = fit(surface, path);
  EXPECT_EQ(fits.refined.T_mesh_world.translation_m, fits.start.T_mesh_world.translation_m);
  ASSERT_FALSE(fits.refined.problems.empty());
  EXPECT_EQ(fits.refined.problems.back().kind, "not_refined");
}

// A path of kilometres, as a file in other units than metres has it: its knots are held to a number that fits memory.
TEST(RefineRegistration, AVeryLongPathHasFewKnots) {
  const MeshSurface surface(ball());
  MeasuredPath path = scan(surface, {50e-6, 30e-6}, 7);
  const Fits near = fit(surface, path);
  for (int i = 0; i < 4; ++i) path.p_world_m.emplace_back(1e6 * i, 0.0, 0.0);
  const RefinedRegistration far = refine_registration({&path, 1}, surface, near.start, {}, {}, {});
  EXPECT_TRUE(std::any_of(far.registration.problems.begin(), far.registration.problems.end(),
                          [](const Problem& problem) { return problem.kind == "wide_knots"; }));
}

}  // namespace
}  // namespace asperity
