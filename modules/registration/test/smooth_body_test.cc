// On a smooth body little but its curvature over centimetres tells where a path is. The body here has the mesh's
// facets, whose kinks would fit again with each edge further: the stated errors have to hold all the same.

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/Cholesky>

#include "asperity/registration/refine_placements.h"
#include "asperity/registration/register_path.h"
#include "bumpy_ball.h"

namespace asperity {
namespace {

using Eigen::Vector3d;
using Vector6 = Eigen::Matrix<double, 6, 1>;

const Pose kTruth{Eigen::Quaterniond(Eigen::AngleAxisd(0.4, Vector3d(1, -2, 1).normalized())),
                  Vector3d(0.05, 0.02, -0.3)};

// An ellipsoid of 95 × 76 × 61 mm with twelve low bumps, its edges of 2 mm in rows.
TriangleMesh smooth_pebble(std::uint64_t seed) {
  constexpr int kRows = 60, kColumns = 120;
  Random random(seed);
  std::vector<Vector3d> bumps;
  std::vector<double> height;
  for (int k = 0; k < 12; ++k) {
    bumps.push_back(Vector3d(random.normal(), random.normal(), random.normal()).normalized());
    height.push_back(3e-3 * random.normal());
  }
  TriangleMesh mesh;
  for (int row = 0; row <= kRows; ++row) {
    const double latitude = std::numbers::pi * (static_cast<double>(row) / kRows - 0.5);
    for (int column = 0; column < kColumns; ++column) {
      const double longitude = 2.0 * std::numbers::pi * column / kColumns;
      const Vector3d out(std::cos(latitude) * std::cos(longitude), std::cos(latitude) * std::sin(longitude),
                         std::sin(latitude));
      double radius_m = 38e-3;
      for (std::size_t k = 0; k < bumps.size(); ++k)
        radius_m += height[k] * std::exp(-(out - bumps[k]).squaredNorm() / (2.0 * 0.35 * 0.35));
      mesh.vertices_m.emplace_back(radius_m * out.cwiseProduct(Vector3d(1.25, 1.0, 0.8)));
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

TEST(SmoothBody, TheCovarianceHolds) {
  constexpr int kTrials = 16;
  double squares = 0.0, worst = 0.0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const MeshSurface surface(smooth_pebble(1 + static_cast<std::uint64_t>(trial)));
    const RegistrationSurface ready = prepare_surface(surface.mesh, surface.bvh);
    std::vector<MeasuredPath> paths;
    for (int k = 0; k < 2; ++k) {
      BallStroke stroke;
      stroke.begin_rad = 0.4 * trial + 1.5 * k;
      stroke.end_rad = stroke.begin_rad + 2.0;
      stroke.lean_phase = 0.7 * trial + 2.0 * k;
      stroke.relief_m = 40e-6;
      stroke.slow_m = 0.15e-3;
      paths.push_back(stroke_over_ball(surface, kTruth, stroke,
                                       500 + 10 * static_cast<std::uint64_t>(trial) + static_cast<std::uint64_t>(k)));
    }
    RegistrationConfig search;
    search.starts.when = OtherStarts::kNever;
    const std::vector<RegistrationResult> starts{register_path(paths, ready, kTruth, search)};
    const std::vector<std::size_t> placement_of{0, 0};
    const RegistrationResult found =
        refine_placements(paths, placement_of, surface, starts, {}, {}).registrations.front();
    const Eigen::Quaterniond turn = found.T_mesh_world.rotation * kTruth.rotation.conjugate();
    Vector6 error;
    error << log_rotation(turn),
        found.T_mesh_world.translation_m - found.centre_mesh_m - turn * (kTruth.translation_m - found.centre_mesh_m);
    const double square = error.dot(found.covariance.ldlt().solve(error));
    squares += square / kTrials;
    worst = std::max(worst, square);
  }
  // χ² of six: the mean over 16 trials is 6 ± 0.87, and one in 16 · 5000 is above 30.
  EXPECT_GT(squares, 2.5);
  EXPECT_LT(squares, 9.5);
  EXPECT_LT(worst, 30.0);
}

}  // namespace
}  // namespace asperity
