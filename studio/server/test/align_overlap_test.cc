#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "align/residual_sigma.h"
#include "align/scan_overlaps.h"
#include "asperity/base/random.h"
#include "asperity/geometry/pose.h"

namespace asperity::studio {
namespace {

// Two triangles in the plane z = 0.
TriangleMesh plate() {
  return {{{-0.1, -0.1, 0.0}, {0.1, -0.1, 0.0}, {0.1, 0.1, 0.0}, {-0.1, 0.1, 0.0}}, {{0, 1, 2}, {0, 2, 3}}};
}

AlignScene scene_of(const std::vector<MeasuredPath>& paths) {
  AlignScene out{{}, MeshSurface(plate()), {}, {}, {}};
  for (std::size_t k = 0; k < paths.size(); ++k) {
    out.scans.points.push_back({paths[k], {}});
    out.of.paths.push_back(std::to_string(k));
    for (std::size_t i = 0; i < paths[k].p_world_m.size(); ++i) {
      out.p_world_m.push_back(paths[k].p_world_m[i]);
      out.path.push_back(static_cast<std::uint32_t>(k));
      out.point.push_back(static_cast<std::uint32_t>(i));
    }
  }
  return out;
}

PathResiduals residuals_of(const AlignScene& scene, const Pose& pose) {
  std::vector<ClosestPoint> closest;
  return path_residuals(scene.p_world_m, scene.surface, pose, closest);
}

// The oracle draws the errors that the path states and looks how far the distances scatter.
TEST(ResidualSigma, IsTheScatterOfDistancesUnderTheStatedErrors) {
  const Pose T_mesh_world{exp_rotation({0.4, -0.7, 0.2}), {0.01, 0.02, 0.03}};
  MeasuredPath path;
  path.p_world_m.push_back(T_mesh_world.inverse() * Eigen::Vector3d(0.02, -0.01, 1e-3));
  path.slow_covariance_world_m2 << 9e-12, 2e-12, 0.0, 2e-12, 4e-12, 1e-12, 0.0, 1e-12, 16e-12;
  path.q_world_marker.emplace_back(exp_rotation({1.0, 0.3, -0.5}));
  path.tip_sigma_m = {5e-6, 1e-6, 8e-6};
  const AlignScene scene = scene_of({path});
  const ResidualSigma sigma = residual_sigma(scene, residuals_of(scene, T_mesh_world), {T_mesh_world});

  Random random(9);
  const Eigen::Matrix3d root = path.slow_covariance_world_m2.llt().matrixL();
  const auto normal = [&] { return Eigen::Vector3d(random.normal(), random.normal(), random.normal()); };
  double square_m2 = 0.0;
  constexpr int kDraws = 20000;
  for (int draw = 0; draw < kDraws; ++draw) {
    const Eigen::Vector3d error_m =
        root * normal() + path.q_world_marker[0] * Eigen::Vector3d(path.tip_sigma_m.cwiseProduct(normal()));
    const Eigen::Vector3d p_m = T_mesh_world * Eigen::Vector3d(path.p_world_m[0] + error_m);
    square_m2 += std::pow(p_m.z() - 1e-3, 2) / kDraws;
  }
  // A variance from 20,000 draws is known to 1 %, its root to half of that; four of these.
  EXPECT_NEAR(sigma.sigma_m.at(0), std::sqrt(square_m2), 0.02 * std::sqrt(square_m2));
  EXPECT_NEAR(sigma.rms, 1e-3 / sigma.sigma_m[0], 1e-3 * sigma.rms);
  EXPECT_NEAR(sigma.median_m, sigma.sigma_m[0], 1e-12);
}

TEST(ResidualSigma, IsNotKnownOfAPathThatStatesNone) {
  MeasuredPath silent, spoken;
  silent.p_world_m = spoken.p_world_m = {{0.0, 0.0, 2e-3}};
  spoken.sigma_m = 1e-4;
  const AlignScene scene = scene_of({silent, spoken});
  const ResidualSigma sigma = residual_sigma(scene, residuals_of(scene, {}), {{}, {}});
  EXPECT_TRUE(std::isnan(sigma.sigma_m[0]));
  EXPECT_FLOAT_EQ(sigma.sigma_m[1], 1e-4F);
  EXPECT_NEAR(sigma.rms, 20.0, 1e-5);  // of the one that is known
  const AlignScene none = scene_of({silent});
  EXPECT_TRUE(std::isnan(residual_sigma(none, residuals_of(none, {}), {{}}).rms));
}

TEST(ScanOverlaps, AreThoseOfBruteForce) {
  Random random(4);
  std::vector<MeasuredPath> paths(3);
  for (MeasuredPath& path : paths) {
    Eigen::Vector3d p_m(random.uniform(-1e-3, 1e-3), random.uniform(-1e-3, 1e-3), 0.0);
    for (int i = 0; i < 300; ++i) {
      p_m += Eigen::Vector3d(random.uniform(-0.3e-3, 0.3e-3), random.uniform(-0.3e-3, 0.3e-3), 0.0);
      path.p_world_m.push_back(p_m);
    }
  }
  const AlignScene scene = scene_of(paths);
  const std::vector<Pose> poses{
      {}, {exp_rotation({0.0, 0.0, 0.3}), {1e-3, 0.0, 0.0}}, {exp_rotation({0.1, 0.0, 0.0}), {0.0, -1e-3, 0.0}}};
  const double reach_m = overlap_reach_m(scene);
  EXPECT_NEAR(reach_m, 0.55e-3, 1e-9);  // overlap_m and spacing_m of the defaults
  for (const std::vector<Pose>& by : {std::vector<Pose>{}, poses}) {
    const std::vector<std::uint8_t> found = scan_overlaps(scene, by);
    ASSERT_EQ(found.size(), scene.p_world_m.size());
    std::size_t marked = 0;
    for (std::size_t i = 0; i < found.size(); ++i) {
      bool near = false;
      for (std::size_t j = 0; j < found.size(); ++j) {
        if (scene.path[i] == scene.path[j]) continue;
        const auto placed = [&](std::size_t at) {
          return by.empty() ? scene.p_world_m[at] : Eigen::Vector3d(by[scene.path[at]] * scene.p_world_m[at]);
        };
        near |= (placed(i) - placed(j)).norm() <= reach_m;
      }
      EXPECT_EQ(found[i] != 0, near) << i;
      marked += near ? 1 : 0;
    }
    EXPECT_GT(marked, 10U);  // or the test would show nothing
    EXPECT_LT(marked, found.size());
  }
}

TEST(ScanOverlaps, OneScanHasNone) {
  MeasuredPath path;
  path.p_world_m.assign(5, Eigen::Vector3d::Zero());
  EXPECT_EQ(scan_overlaps(scene_of({path}), {}), std::vector<std::uint8_t>(5, 0));
}

}  // namespace
}  // namespace asperity::studio
