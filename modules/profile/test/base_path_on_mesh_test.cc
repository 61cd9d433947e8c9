#include "asperity/profile/base_path_on_mesh.h"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "asperity/base/error.h"
#include "asperity/geometry/mesh_surface.h"
#include "asperity/geometry/pose.h"

namespace asperity {
namespace {

using Eigen::Vector3d;

constexpr double kRate_hz = 2000.0;
constexpr double kSpeed_mps = 0.025;
const Vector3d kTipInMarker_m(0.0, 0.0, -0.1);
const Pose kMeshFromWorld{Eigen::Quaterniond(Eigen::AngleAxisd(0.7, Vector3d(1, 2, -1).normalized())),
                          Vector3d(0.3, -0.2, 0.5)};

// A cylinder about z of facets 1 mm wide, open at both ends.
TriangleMesh cylinder(double radius_m, double length_m) {
  constexpr int kAround = 180, kRows = 40;
  TriangleMesh mesh;
  for (int row = 0; row <= kRows; ++row) {
    for (int i = 0; i < kAround; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / kAround;
      mesh.vertices_m.emplace_back(radius_m * std::cos(angle), radius_m * std::sin(angle), length_m * row / kRows);
    }
  }
  for (std::uint32_t row = 0; row < kRows; ++row) {
    for (std::uint32_t i = 0; i < kAround; ++i) {
      const std::uint32_t a = row * kAround + i, b = row * kAround + (i + 1) % kAround;
      mesh.triangles.push_back({a, b, b + kAround});
      mesh.triangles.push_back({a, b + kAround, a + kAround});
    }
  }
  return mesh;
}

// A helix over the cylinder with a sine of 2 mm pitch upon it, the probe held along the outward normal.
struct Helix {
  TipMotion motion;
  std::vector<double> s_m, height_m;
};
Helix scan_helix(double radius_m, bool inside) {
  Helix out;
  constexpr double kClimb = 0.3;  // of the way along the axis
  const double around = std::sqrt(1.0 - kClimb * kClimb);
  for (int i = 0; i < 6000; ++i) {
    const double s_m = kSpeed_mps * i / kRate_hz;
    const double height_m = 0.1e-3 * std::sin(2.0 * std::numbers::pi * s_m / 2e-3);
    const double angle = around * s_m / radius_m;
    const Vector3d radial(std::cos(angle), std::sin(angle), 0.0);
    const double sign = inside ? -1.0 : 1.0;
    const Vector3d p_mesh_m = (radius_m + sign * height_m) * radial + (0.005 + kClimb * s_m) * Vector3d::UnitZ();
    const Eigen::Quaterniond q_mesh_marker = shortest_rotation(Vector3d::UnitZ(), sign * radial);
    const Pose T_world_mesh = kMeshFromWorld.inverse();
    out.motion.t_ns.push_back(static_cast<std::int64_t>(i * 1e9 / kRate_hz));
    out.motion.p_world_tip_m.push_back(T_world_mesh * p_mesh_m);
    out.motion.q_world_marker.push_back(T_world_mesh.rotation * q_mesh_marker);
    out.motion.v_world_tip_mps.push_back(Vector3d::Zero());
    out.motion.force_N.push_back(1.0);
    out.s_m.push_back(s_m);
    out.height_m.push_back(height_m);
  }
  return out;
}

// A facet 1 mm wide on a radius of 28.6 mm lies 4 µm under the circle at most.
constexpr double kFacet_m = 5e-6;

TEST(BasePathOnMesh, HeightsAndLengthsOfAHelixAreThoseOfTheCylinder) {
  constexpr double kRadius_m = 0.0286;
  const MeshSurface surface(cylinder(kRadius_m, 0.04));
  const Helix helix = scan_helix(kRadius_m, false);
  const BasePathResult result = base_path_on_mesh(helix.motion, kTipInMarker_m, surface, kMeshFromWorld, {});
  EXPECT_EQ(result.shape, PathShape::kMesh);
  EXPECT_TRUE(result.problems.empty());
  EXPECT_LT(result.probe_tilt_deg, 1.0);
  for (std::size_t i = 0; i < helix.s_m.size(); ++i) {
    const double height_m = result.path.n_world[i].dot(helix.motion.p_world_tip_m[i] - result.path.p_world_m[i]);
    ASSERT_NEAR(height_m, helix.height_m[i], kFacet_m) << i;
    // The polygon is shorter than the circle by (θ²/24), 5e-5, and the direction of travel is known to 2°.
    ASSERT_NEAR(result.path.s_m[i], helix.s_m[i], 2e-6 + 7e-4 * helix.s_m[i]) << i;
  }
}

// Facets rounded by their normals are the cylinder: no kink stays in the heights.
TEST(BasePathOnMesh, RoundedFacetsLeaveNoKinksInTheHeights) {
  constexpr double kRadius_m = 0.0286;
  const MeshSurface surface(cylinder(kRadius_m, 0.04));
  const Helix helix = scan_helix(kRadius_m, false);
  const auto worst_m = [&](double bulge_share) {
    const BasePathResult result =
        base_path_on_mesh(helix.motion, kTipInMarker_m, surface, kMeshFromWorld, {}, bulge_share);
    double largest_m = 0.0;
    for (std::size_t i = 0; i < helix.s_m.size(); ++i) {
      const double height_m = result.path.n_world[i].dot(helix.motion.p_world_tip_m[i] - result.path.p_world_m[i]);
      largest_m = std::max(largest_m, std::abs(height_m - helix.height_m[i]));
    }
    return largest_m;
  };
  EXPECT_GT(worst_m(0.0), 0.5 * kFacet_m);
  EXPECT_LT(worst_m(1.0), 0.2 * worst_m(0.0));  // the tilt between interpolated and true normal is of second order
}

TEST(BasePathOnMesh, AMeshTurnedInsideOutIsSaidToBe) {
  constexpr double kRadius_m = 0.0286;
  const MeshSurface surface(cylinder(kRadius_m, 0.04));
  const Helix helix = scan_helix(kRadius_m, true);
  const BasePathResult result = base_path_on_mesh(helix.motion, kTipInMarker_m, surface, kMeshFromWorld, {});
  ASSERT_EQ(result.problems.size(), 1u);
  EXPECT_EQ(result.problems[0].kind, "inward_normals");
  for (std::size_t i = 0; i < helix.s_m.size(); ++i) {
    const double height_m = result.path.n_world[i].dot(helix.motion.p_world_tip_m[i] - result.path.p_world_m[i]);
    ASSERT_NEAR(height_m, helix.height_m[i], kFacet_m) << i;
  }
}

TEST(BasePathOnMesh, SamplesBeyondABorderAreCounted) {
  constexpr double kRadius_m = 0.0286;
  const MeshSurface surface(cylinder(kRadius_m, 0.016));  // the helix climbs to 27 mm
  const Helix helix = scan_helix(kRadius_m, false);
  const BasePathResult result = base_path_on_mesh(helix.motion, kTipInMarker_m, surface, kMeshFromWorld, {});
  ASSERT_EQ(result.problems.size(), 1u);
  EXPECT_EQ(result.problems[0].kind, "beyond_the_mesh");
  EXPECT_NEAR(static_cast<double>(result.problems[0].count), (0.0275 - 0.016) / 0.3 / kSpeed_mps * kRate_hz, 5.0);
}

TEST(BasePathOnMesh, AMotionThatIsNotFiniteIsRefused) {
  const MeshSurface surface(cylinder(0.0286, 0.04));
  Helix helix = scan_helix(0.0286, false);
  helix.motion.p_world_tip_m[17].x() = std::nan("");
  EXPECT_THAT([&] { base_path_on_mesh(helix.motion, kTipInMarker_m, surface, kMeshFromWorld, {}); },
              testing::ThrowsMessage<Error>(testing::HasSubstr("sample 17")));
}

}  // namespace
}  // namespace asperity
