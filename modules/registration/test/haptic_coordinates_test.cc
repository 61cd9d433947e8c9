#include "asperity/registration/haptic_coordinates.h"

#include <cmath>
#include <functional>
#include <numbers>

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "asperity/base/random.h"
#include "asperity/geometry/mesh_bvh.h"
#include "asperity/testkit/shape_meshes.h"
#include "mesh_path_on.h"

namespace asperity {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using std::numbers::pi;

Vector2d interpolated_mm(const HapticTriangle& h, const Vector3d& w) {
  return w[0] * h.xy_mm[0] + w[1] * h.xy_mm[1] + w[2] * h.xy_mm[2];
}

// Every corner's coordinates against the truth, in metres; returns how many triangles there were.
std::size_t expect_coordinates(const TriangleMesh& mesh, const HapticCoordinates& result,
                               const std::function<Vector2d(const Vector3d&)>& truth_m, double tol_m) {
  std::size_t count = 0;
  double worst_m = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (result.triangles[t].texture < 0) continue;
    ++count;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector2d expected_mm = 1e3 * truth_m(mesh.vertices_m[mesh.triangles[t][k]]);
      worst_m = std::max(worst_m, 1e-3 * (result.triangles[t].xy_mm[k] - expected_mm).norm());
    }
  }
  EXPECT_LT(worst_m, tol_m);
  return count;
}

TEST(HapticCoordinates, GiveTheSignsAndLayoutOfFigure33) {
  const TriangleMesh mesh{{{-0.04, 0, 0.04}, {-0.04, 0, -0.04}, {0.04, 0, 0.04}, {0.04, 0, -0.04}},
                          {{0, 2, 1}, {1, 2, 3}}};
  const MeshPath path = mesh_path_on(mesh, 0.08, 0.001, [](double s) { return Vector3d(-0.04, 0.0, 0.04 - s); });
  const auto result = assign_haptic_coordinates(mesh, make_adjacency(mesh), {path});
  const std::array<std::array<Vector2d, 3>, 2> figure{
      {{Vector2d(0, 0), Vector2d(0, 50), Vector2d(50, 0)}, {Vector2d(50, 0), Vector2d(0, 50), Vector2d(50, 50)}}};
  for (std::size_t t = 0; t < 2; ++t) {
    EXPECT_EQ(result.triangles[t].texture, 1);
    for (std::size_t k = 0; k < 3; ++k) {  // the figure spans 50 over 80 mm
      EXPECT_LT((result.triangles[t].xy_mm[k] - 80.0 / 50.0 * figure[t][k]).norm(), 1e-9);
    }
  }
  EXPECT_TRUE(result.problems.empty());
}

TEST(HapticCoordinates, AreExactInThePlaneWhateverTheTriangles) {
  const TriangleMesh mesh = testkit::plane_mesh({0.1, 0.08}, 50, 40, 0.24, 3);
  const Vector2d start(0.023, 0.031);
  const Vector2d along = Vector2d(0.8, 0.6);
  const MeshPath path = mesh_path_on(mesh, 0.045, 0.0002, [&](double s) {
    return Vector3d(start.x() + s * along.x(), start.y() + s * along.y(), 0.0);
  });
  HapticCoordinatesConfig config;
  config.rings = 3;
  const auto result = assign_haptic_coordinates(mesh, make_adjacency(mesh), {path}, config);
  const std::size_t count = expect_coordinates(
      mesh, result,
      [&](const Vector3d& p) {
        const Vector2d d = p.head<2>() - start;
        return Vector2d(d.dot(along), d.x() * along.y() - d.y() * along.x());  // t × n is to the right
      },
      1e-9);
  EXPECT_GT(count, 300u);
  EXPECT_NEAR(result.warps[0].stretch_min, 1.0, 1e-6);
  EXPECT_NEAR(result.warps[0].stretch_max, 1.0, 1e-6);
  EXPECT_TRUE(result.problems.empty());
}

TEST(HapticCoordinates, UnrollAPrism) {
  constexpr int kAround = 60;
  const double radius_m = 0.02;
  const double facet_m = 2.0 * radius_m * std::sin(pi / kAround);
  const TriangleMesh mesh = testkit::cylinder_mesh(radius_m, 0.06, kAround, 30, 2.0 * pi, 4);
  const auto on_prism = [&](double u_m, double z_m) {
    const double k = std::floor(u_m / facet_m);
    const auto at = [&](double n) {
      return Vector3d(radius_m * std::cos(2.0 * pi * n / kAround), radius_m * std::sin(2.0 * pi * n / kAround), z_m);
    };
    return Vector3d(at(k) + (u_m / facet_m - k) * (at(k + 1.0) - at(k)));
  };
  const Vector2d start(5.3 * facet_m, 0.02);
  const Vector2d along = Vector2d(0.96, 0.28);
  const MeshPath path = mesh_path_on(
      mesh, 0.06, 0.0001, [&](double s) { return on_prism(start.x() + s * along.x(), start.y() + s * along.y()); });
  HapticCoordinatesConfig config;
  config.rings = 2;
  const auto result = assign_haptic_coordinates(mesh, make_adjacency(mesh), {path}, config);
  // A closest point is off by rounding only, so that what remains is the smoothing's: none on a straight path.
  const std::size_t count = expect_coordinates(
      mesh, result,
      [&](const Vector3d& p) {
        double n = std::atan2(p.y(), p.x()) / (2.0 * pi) * kAround;
        if (n < -0.5) n += kAround;
        const Vector2d d = Vector2d(n * facet_m, p.z()) - start;
        return Vector2d(d.dot(along), d.x() * along.y() - d.y() * along.x());
      },
      1e-8);
  EXPECT_GT(count, 200u);
}

TEST(HapticCoordinates, TurnOverASharpEdge) {
  const TriangleMesh mesh = testkit::box_mesh({0.03, 0.03, 0.03}, 15);
  // On the top, then down the side x = 0.03, at 30° to the edge's normal.
  const Vector2d start(0.016, 0.008);
  const Vector2d along(std::cos(pi / 6), std::sin(pi / 6));
  const MeshPath path = mesh_path_on(mesh, 0.025, 0.0001, [&](double s) {
    const Vector2d q = start + s * along;
    return q.x() < 0.03 ? Vector3d(q.x(), q.y(), 0.03) : Vector3d(0.03, q.y(), 0.06 - q.x());
  });
  HapticCoordinatesConfig config;
  config.rings = 2;
  const auto result = assign_haptic_coordinates(mesh, make_adjacency(mesh), {path}, config);
  const std::size_t count = expect_coordinates(
      mesh, result,
      [&](const Vector3d& p) {
        const Vector2d d = Vector2d(p.x() + (0.03 - p.z()), p.y()) - start;
        return Vector2d(d.dot(along), d.x() * along.y() - d.y() * along.x());
      },
      1e-8);
  EXPECT_GT(count, 150u);
}

TEST(HapticCoordinates, GiveBackTheLengthAlongACurvedNoisyPath) {
  constexpr double kRadius_m = 0.02;  // the tightest path this is promised for
  for (const double edge_m : {0.0015, 0.003}) {
    const int cells = static_cast<int>(std::lround(0.06 / edge_m));
    const TriangleMesh mesh = testkit::plane_mesh({0.06, 0.06}, cells, cells, 0.24, 8);
    const auto curve = [&](double s, double outwards_m) {
      const double angle = s / kRadius_m;
      return Vector3d(0.03 + (kRadius_m + outwards_m) * std::cos(angle),
                      0.03 + (kRadius_m + outwards_m) * std::sin(angle), 0.0);
    };
    Random random(5);
    const MeshPath noisy = mesh_path_on(mesh, 0.08, 0.0001, [&](double s) { return curve(s, 2e-4 * random.normal()); });
    const MeshPath truth = mesh_path_on(mesh, 0.08, 0.0001, [&](double s) { return curve(s, 0.0); });
    const auto result = assign_haptic_coordinates(mesh, make_adjacency(mesh), {noisy});
    const MeshBvh bvh(mesh);
    double worst_m = 0.0;
    double square = 0.0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
      const ClosestPoint c = bvh.closest_point(truth.p_mesh_m[i]);
      ASSERT_EQ(result.triangles[c.triangle].texture, 1);
      const Vector2d xy_mm = interpolated_mm(result.triangles[c.triangle], c.barycentric);
      const double error_m = 1e-3 * xy_mm.x() - truth.s_m[i];
      worst_m = std::max(worst_m, std::abs(error_m));
      square += error_m * error_m;
    }
    // A triangle's x is linear: with a path that clips its corners what remains grows with its edges squared.
    EXPECT_LT(worst_m, edge_m < 0.002 ? 5e-5 : 1e-4);
    EXPECT_LT(std::sqrt(square / static_cast<double>(truth.size())), 4e-5);
    EXPECT_NEAR(result.warps[0].across_rms_m, 2e-4, 3e-5);
    EXPECT_NEAR(result.warps[0].length_ratio, 1.0, 2e-3);
  }
}

TEST(HapticCoordinates, FollowGreatCirclesOfASphere) {
  const double radius_m = 0.03;
  const TriangleMesh mesh = testkit::sphere_mesh(radius_m, 5);  // edges of 1 mm
  const Vector3d a = Vector3d(1.0, 0.2, 0.1).normalized();
  const Vector3d n = a.cross(Vector3d(0.1, 1.0, 0.4)).normalized();  // of the circle; to the right is -n
  const Vector3d b = n.cross(a);
  const MeshPath path = mesh_path_on(mesh, 0.05, 0.0001, [&](double s) {
    return Vector3d(radius_m * (std::cos(s / radius_m) * a + std::sin(s / radius_m) * b));
  });
  HapticCoordinatesConfig config;
  config.rings = 3;
  const auto result = assign_haptic_coordinates(mesh, make_adjacency(mesh), {path}, config);
  // Beyond the ends (x below 0 or above 50 mm) and within: longitude and latitude about the circle. Chords
  // are shorter than arcs by h²/24 R² = 5e-5 of 25 mm, and x is fitted along the path.
  expect_coordinates(
      mesh, result,
      [&](const Vector3d& p) {
        double angle = std::atan2(p.dot(b), p.dot(a));
        return Vector2d(radius_m * angle, -radius_m * std::asin(std::clamp(p.dot(n) / radius_m, -1.0, 1.0)));
      },
      2e-5);
}

TEST(HapticCoordinates, KeepTheSideOfNonManifoldEdgesAndBorders) {
  // A page upright on a plane: a path on the plane towards and past the page's foot.
  TriangleMesh mesh = testkit::plane_mesh({0.02, 0.02}, 20, 20);
  const auto base = static_cast<std::uint32_t>(mesh.vertices_m.size());
  for (std::uint32_t j = 0; j <= 20; ++j) mesh.vertices_m.push_back({0.01, 0.001 * j, 0.005});
  for (std::uint32_t j = 0; j < 20; ++j) {
    const std::uint32_t foot = j * 21 + 10;
    mesh.triangles.push_back({foot, foot + 21, base + j});
    mesh.triangles.push_back({foot + 21, base + j + 1, base + j});
  }
  const MeshPath path = mesh_path_on(mesh, 0.01, 0.0001, [](double s) { return Vector3d(0.005 + s, 0.0103, 0.0); });
  const auto result = assign_haptic_coordinates(mesh, make_adjacency(mesh), {path});
  for (std::size_t t = 0; t < 800; ++t) {
    if (result.triangles[t].texture < 0) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3d& p = mesh.vertices_m[mesh.triangles[t][k]];
      EXPECT_LT((result.triangles[t].xy_mm[k] - 1e3 * Vector2d(p.x() - 0.005, 0.0103 - p.y())).norm(), 1e-3);
    }
  }
}

}  // namespace
}  // namespace asperity
