#include "asperity/registration/mesh_scale.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "asperity/registration/register_path.h"
#include "test_surfaces.h"

namespace asperity {
namespace {

using test::Body;
using test::kWorldMesh;

constexpr double kSlow_m = 0.1e-3, kLength_m = 20e-3;

// What a scan of an object of `size` times the mesh measures: contact points with the slow error of a tracker, relief,
// and the tip's calibrated position off by `tip_m` in a marker that follows the normals.
MeasuredPath scan_of(const Body& body, const std::vector<Eigen::Vector3d>& p_m, double size,
                     const Eigen::Vector3d& tip_m, Random& random) {
  MeasuredPath out;
  Eigen::Vector3d slow_m = kSlow_m * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
  for (std::size_t i = 0; i < p_m.size(); ++i) {
    const double step_m = i == 0 ? 0.0 : size * (p_m[i] - p_m[i - 1]).norm();
    const double keep = std::exp(-step_m / kLength_m);
    slow_m = keep * slow_m + std::sqrt(1.0 - keep * keep) * kSlow_m *
                                 Eigen::Vector3d(random.normal(), random.normal(), random.normal());
    const ClosestPoint at = body.bvh.closest_point(p_m[i]);
    const Eigen::Vector3d n = body.surface.facets[at.triangle].normal.cast<double>();
    const Eigen::Quaterniond marker =
        kWorldMesh.rotation * Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), n);
    out.p_world_m.push_back(kWorldMesh * Eigen::Vector3d(size * p_m[i] + 20e-6 * random.normal() * n) + slow_m +
                            marker * tip_m);
    out.outward_world.push_back(kWorldMesh.rotation * n);
    out.q_world_marker.push_back(marker);
  }
  out.slow_covariance_world_m2 = kSlow_m * kSlow_m * Eigen::Matrix3d::Identity();
  out.sigma_m = kSlow_m;
  return out;
}

std::vector<WeighedPose> starts_at_truth(const Body& body, const MeasuredPath& path) {
  return {weigh_pose({&path, 1}, body.surface, kWorldMesh.inverse(), {}, {}, {})};
}

TEST(MeshScale, FindsTheSizeAndItsError) {
  const Body& body = test::bumpy_body();
  const auto p_m = test::bumpy_path(body, 800);
  double square = 0.0;
  constexpr int kScans = 12;
  for (int k = 0; k < kScans; ++k) {
    Random random(100 + static_cast<std::uint64_t>(k));
    const double size = 0.96 + 0.08 * k / (kScans - 1.0);
    const MeasuredPath path = scan_of(body, p_m, size, Eigen::Vector3d::Zero(), random);
    const MeshScale found = measure_mesh_scale({&path, 1}, body.surface, starts_at_truth(body, path), {}, {});
    EXPECT_LT(found.sigma, 0.01);
    const double z = (std::log(found.ratio) - std::log(size)) / found.sigma;
    EXPECT_LT(std::abs(z), 4.0) << size;
    square += z * z / kScans;
  }
  // χ² with 12 degrees of freedom over 12: within 0.25 and 2.4 with 99 %. The prior of the slow error's size widens it.
  EXPECT_LT(square, 2.4);
  EXPECT_GT(square, 0.2);
}

TEST(MeshScale, FindsAMeshThatIsFarTooLargeOrTooSmall) {
  const Body& body = test::bumpy_body();
  const auto p_m = test::bumpy_path(body, 800);
  for (const double size : {0.77, 0.9, 1.1, 1.3}) {
    Random random(7);
    const MeasuredPath path = scan_of(body, p_m, size, Eigen::Vector3d::Zero(), random);
    // From where the path fits the mesh best as it is.
    const Pose fitted = register_path({&path, 1}, body.surface, kWorldMesh.inverse(), {}).T_mesh_world;
    const std::vector<WeighedPose> starts{weigh_pose({&path, 1}, body.surface, fitted, {}, {}, {})};
    const MeshScale found = measure_mesh_scale({&path, 1}, body.surface, starts, {}, {});
    // From a pose that is a quarter of the size off, another maximum on the way may be the end.
    if (size > 0.8) {
      EXPECT_NEAR(std::log(found.ratio), std::log(size), 4.0 * found.sigma) << size;
    }
    EXPECT_GT(std::abs(std::log(found.ratio)), 0.5 * std::abs(std::log(size))) << size;
    EXPECT_GT(std::log(found.ratio) * std::log(size), 0.0) << size;
    EXPECT_LT(found.sigma, 0.02) << size;
    EXPECT_GT(found.gain, 12.25) << size;
  }
}

// A tip that is 0.3 mm longer than calibrated makes a body of about 35 mm radius 0.9 % larger: the stated error of the
// tip has to cover it.
TEST(MeshScale, TheTipsErrorIsInItsOwn) {
  const Body& body = test::bumpy_body();
  const auto p_m = test::bumpy_path(body, 800);
  Random random(9);
  MeasuredPath path = scan_of(body, p_m, 1.0, {0.0, 0.0, 0.3e-3}, random);
  const MeshScale exact = measure_mesh_scale({&path, 1}, body.surface, starts_at_truth(body, path), {}, {});
  EXPECT_NEAR(exact.ratio, 1.009, 0.004);
  path.tip_sigma_m.setConstant(0.2e-3);
  const MeshScale stated = measure_mesh_scale({&path, 1}, body.surface, starts_at_truth(body, path), {}, {});
  EXPECT_EQ(stated.ratio, exact.ratio);
  EXPECT_GT(stated.sigma, 0.004);
  EXPECT_LT(std::abs(std::log(stated.ratio)), 2.5 * stated.sigma);
}

TEST(MeshScale, APlaneHasAnySize) {
  const Body plane(
      test::grid(4, 4, [](double u, double v) { return Eigen::Vector3d(0.4 * u - 0.2, 0.4 * v - 0.2, 0.0); }));
  std::vector<Eigen::Vector3d> p_m;
  for (int i = 0; i < 400; ++i) p_m.emplace_back(0.25e-3 * i - 50e-3, 10e-3 * std::sin(0.02 * i), 0.0);
  Random random(3);
  const MeasuredPath path = scan_of(plane, p_m, 1.0, Eigen::Vector3d::Zero(), random);
  const MeshScale found = measure_mesh_scale({&path, 1}, plane.surface, starts_at_truth(plane, path), {}, {});
  EXPECT_GT(found.sigma, 0.2);
  EXPECT_LT(found.gain, 4.0);
}

}  // namespace
}  // namespace asperity
