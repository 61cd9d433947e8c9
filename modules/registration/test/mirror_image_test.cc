#include "asperity/registration/mirror_image.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "asperity/registration/find_symmetry.h"
#include "symmetric_bodies.h"
#include "test_surfaces.h"

namespace asperity {
namespace {

using test::Body;
using test::kWorldMesh;

constexpr double kImageOdds = -4.6;  // ln 0.01

double odds_at_truth(const Body& body, const MeasuredPath& path) {
  const std::vector<WeighedPose> at{weigh_pose({&path, 1}, body.surface, kWorldMesh.inverse(), {}, {}, {})};
  return weigh_mirror_image({&path, 1}, body.surface, at, {}, {});
}

MeasuredPath scan(const std::vector<Eigen::Vector3d>& p_m, std::uint64_t seed) {
  Random random(seed);
  MeasuredPath out = test::measured(p_m, 0.05e-3, random);
  out.slow_covariance_world_m2 = 2.5e-9 * Eigen::Matrix3d::Identity();
  return out;
}

TEST(MirrorImage, APathThatLeavesItsPlaneTellsTheMeshFromItsImage) {
  const Body& body = test::bumpy_body();
  EXPECT_LT(odds_at_truth(body, scan(test::bumpy_path(body, 800), 3)), kImageOdds);
}

// The scan of the mirrored object: its own image is the scan of the mesh.
TEST(MirrorImage, OnTheImageOfItsObjectAPathFitsTheImageOfTheMesh) {
  const Body& body = test::bumpy_body();
  MeasuredPath path = scan(test::bumpy_path(body, 800), 3);
  Eigen::Vector3d mean_m = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p_m : path.p_world_m) mean_m += p_m / static_cast<double>(path.p_world_m.size());
  const Eigen::Vector3d n = Eigen::Vector3d(0.3, -0.4, 0.8).normalized();
  const Eigen::Matrix3d S = Eigen::Matrix3d::Identity() - 2.0 * n * n.transpose();
  for (Eigen::Vector3d& p_m : path.p_world_m) p_m = mean_m + S * (p_m - mean_m);
  for (Eigen::Vector3d& outward : path.outward_world) outward = S * outward;
  // Near the truth but for a reflection in another plane: a rotation, of which the half turns about the path's
  // principal axes are tried, so the plane is turned onto the path's own first.
  Eigen::Matrix3d spread_m2 = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& p_m : path.p_world_m) spread_m2 += (p_m - mean_m) * (p_m - mean_m).transpose();
  const Eigen::Vector3d least = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread_m2).eigenvectors().col(0);
  const Eigen::Matrix3d own = Eigen::Matrix3d::Identity() - 2.0 * least * least.transpose();
  const Eigen::Quaterniond turn((own * S).eval());
  const Pose start = kWorldMesh.inverse() * Pose{turn, mean_m - turn * mean_m};
  const std::vector<WeighedPose> at{weigh_pose({&path, 1}, body.surface, start, {}, {}, {})};
  EXPECT_GT(weigh_mirror_image({&path, 1}, body.surface, at, {}, {}), 10.0);
}

// Round a bumpy body in one plane: the path is its own image, whatever the body is elsewhere.
TEST(MirrorImage, APathInAPlaneTellsNothing) {
  const Body& body = test::bumpy_body();
  std::vector<Eigen::Vector3d> p_m;
  for (int i = 0; i < 500; ++i) {
    // Where a plane cuts the surface, by bisection along rays from within.
    const double angle = 1.6 * i / 499.0;
    const Eigen::Vector3d ray(std::cos(angle), std::sin(angle), 0.0);
    const RayHit hit = body.bvh.cast_ray(0.2 * ray, -ray, 1.0);
    ASSERT_TRUE(hit.found());
    p_m.push_back((0.2 - hit.t) * ray);
  }
  const double odds = odds_at_truth(body, scan(p_m, 5));
  EXPECT_GT(odds, kImageOdds);
  EXPECT_LT(odds, 4.6);  // the other way round as little
}

TEST(MirrorImage, AMeshThatIsItsOwnImageIsNotAsked) {
  const Body sphere(test::sphere_mesh(35e-3, 0.0));
  std::vector<Eigen::Vector3d> p_m;
  for (int i = 0; i < 400; ++i) {
    const double t = i / 399.0;
    p_m.emplace_back(-35e-3 * std::cos(1.2 * t), 35e-3 * std::sin(1.2 * t), 8e-3 * std::sin(7.0 * t));
  }
  EXPECT_TRUE(std::isnan(odds_at_truth(sphere, scan(test::laid_on(sphere, p_m), 2))));
}

TEST(MirrorImage, OwnImages) {
  Eigen::Affine3d flip = Eigen::Affine3d::Identity();
  flip.linear()(0, 0) = -1.0;
  const Body prism(test::prism_mesh(3, 40e-3, 60e-3));
  Eigen::Affine3d upside_down = Eigen::Affine3d::Identity();
  upside_down.linear()(2, 2) = -1.0;
  EXPECT_TRUE(is_own_image(prism.surface, upside_down, 2e-6));
  EXPECT_FALSE(is_own_image(test::bumpy_body().surface, flip, 2e-6));
}

}  // namespace
}  // namespace asperity
