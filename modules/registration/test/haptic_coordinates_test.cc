#include "asperity/registration/haptic_coordinates.h"

#include <cmath>
#include <functional>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "asperity/base/error.h"
#include "asperity/base/random.h"
#include "asperity/geometry/mesh_bvh.h"
#include "asperity/testkit/shape_meshes.h"

namespace asperity {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using std::numbers::pi;

// The mesh's points nearest to those of a curve given by its length.
MeshPath path_on(const TriangleMesh& mesh, double length_m, double step_m,
                 const std::function<Vector3d(double)>& curve) {
  const MeshBvh bvh(mesh);
  MeshPath path;
  const int steps = static_cast<int>(std::ceil(length_m / step_m));
  for (int i = 0; i <= steps; ++i) {
    const double s_m = length_m * i / steps;
    const ClosestPoint c = bvh.closest_point(curve(s_m));
    path.p_mesh_m.push_back(c.p_m);
    path.triangle.push_back(c.triangle);
    path.s_m.push_back(s_m);
  }
  return path;
}

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
  const MeshPath path = path_on(mesh, 0.08, 0.001, [](double s) { return Vector3d(-0.04, 0.0, 0.04 - s); });
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
  const MeshPath path = path_on(mesh, 0.045, 0.0002, [&](double s) {
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

TEST(HapticCoordinates, TakeTouchedTrianglesAndRingsOfThoseThatShareAVertex) {
  const TriangleMesh mesh = testkit::plane_mesh({0.02, 0.02}, 20, 20);
  const MeshAdjacency adjacency = make_adjacency(mesh);
  const MeshPath path = path_on(mesh, 0.003, 0.0001, [](double s) { return Vector3d(0.0082 + s, 0.0105, 0.0); });
  HapticCoordinatesConfig config;
  config.extension_mm = 0.1;
  for (const int rings : {0, 1, 2}) {
    config.rings = rings;
    const auto result = assign_haptic_coordinates(mesh, adjacency, {path}, config);
    // Brute force: grow the touched triangles over shared vertices.
    std::vector<bool> in(mesh.triangles.size(), false);
    for (std::size_t t = 0; t < in.size(); ++t) {
      const auto& [a, b, c] = mesh.triangles[t];
      for (int i = 0; i <= 3200; ++i) {
        const Vector2d p(0.0081 + 1e-6 * i, 0.0105);
        const auto side = [&](std::uint32_t u, std::uint32_t v) {
          const Vector2d e = (mesh.vertices_m[v] - mesh.vertices_m[u]).head<2>();
          const Vector2d d = p - mesh.vertices_m[u].head<2>();
          return e.x() * d.y() - e.y() * d.x() >= 0.0;
        };
        if (side(a, b) && side(b, c) && side(c, a)) in[t] = true;
      }
    }
    for (int ring = 0; ring < rings; ++ring) {
      std::vector<bool> vertex(mesh.vertices_m.size(), false);
      for (std::size_t t = 0; t < in.size(); ++t) {
        if (in[t])
          for (const std::uint32_t v : mesh.triangles[t]) vertex[v] = true;
      }
      for (std::size_t t = 0; t < in.size(); ++t) {
        for (const std::uint32_t v : mesh.triangles[t]) in[t] = in[t] || vertex[v];
      }
    }
    for (std::size_t t = 0; t < in.size(); ++t) EXPECT_EQ(result.triangles[t].texture >= 0, in[t]) << t;
  }
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
  const MeshPath path = path_on(
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
  const MeshPath path = path_on(mesh, 0.025, 0.0001, [&](double s) {
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

TEST(HapticCoordinates, OfAThinPlateStayOnItsFront) {
  const TriangleMesh mesh = testkit::box_mesh({0.03, 0.03, 0.0004}, 15);
  const MeshPath path = path_on(mesh, 0.01, 0.0001, [](double s) { return Vector3d(0.01 + s, 0.015, 0.0004); });
  HapticCoordinatesConfig config;
  config.rings = 0;
  config.half_width_mm = 5.0;
  const auto result = assign_haptic_coordinates(mesh, make_adjacency(mesh), {path}, config);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const std::uint32_t v : mesh.triangles[t]) {
      if (result.triangles[t].texture >= 0) {
        EXPECT_EQ(mesh.vertices_m[v].z(), 0.0004);
      }
    }
  }
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
    const MeshPath noisy = path_on(mesh, 0.08, 0.0001, [&](double s) { return curve(s, 2e-4 * random.normal()); });
    const MeshPath truth = path_on(mesh, 0.08, 0.0001, [&](double s) { return curve(s, 0.0); });
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
  const MeshPath path = path_on(mesh, 0.05, 0.0001, [&](double s) {
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

TEST(HapticCoordinates, OfALoopTearBetweenItsEndsAlone) {
  const double radius_m = 0.01;
  constexpr int kAround = 40;
  const TriangleMesh mesh = testkit::cylinder_mesh(radius_m, 0.02, kAround, 13, 2.0 * pi, 4);
  const double around_m = 2.0 * kAround * radius_m * std::sin(pi / kAround);
  const MeshPath path = path_on(mesh, around_m, 0.0001, [&](double s) {
    const double angle = 2.0 * pi * s / around_m;
    return Vector3d(radius_m * std::cos(angle + 0.4), radius_m * std::sin(angle + 0.4), 0.0101);
  });
  const auto result = assign_haptic_coordinates(mesh, make_adjacency(mesh), {path});
  const HapticWarp& warp = result.warps[0];
  EXPECT_THAT(warp.overlapping.size(), testing::AllOf(testing::Gt(0u), testing::Lt(20u)));
  EXPECT_TRUE(warp.folded.empty());
  EXPECT_NEAR(warp.stretch_min, 1.0, 0.01);  // the curve's length is shared out by angle, not by facet
  EXPECT_NEAR(warp.stretch_max, 1.0, 0.01);
}

TEST(HapticCoordinates, OfSeveralPathsAreTheNearestOnes) {
  const TriangleMesh mesh = testkit::plane_mesh({0.04, 0.04}, 40, 40, 0.2, 3);
  const MeshPath lower = path_on(mesh, 0.03, 0.0002, [](double s) { return Vector3d(0.005 + s, 0.015, 0.0); });
  const MeshPath upper = path_on(mesh, 0.03, 0.0002, [](double s) { return Vector3d(0.035 - s, 0.019, 0.0); });
  HapticCoordinatesConfig config;
  config.rings = 4;
  const auto result = assign_haptic_coordinates(mesh, make_adjacency(mesh), {lower, upper}, config);
  EXPECT_GT(result.contested, 50u);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (result.triangles[t].texture < 0) continue;
    Vector3d middle = Vector3d::Zero();
    for (const std::uint32_t v : mesh.triangles[t]) middle += mesh.vertices_m[v] / 3.0;
    if (middle.x() < 0.006 || middle.x() > 0.034 || std::abs(middle.y() - 0.017) < 1e-5) continue;
    EXPECT_EQ(result.triangles[t].texture, middle.y() < 0.017 ? 1 : 2);
  }
}

TEST(HapticCoordinates, FoldInsideATightBendAndSaySo) {
  const TriangleMesh mesh = testkit::plane_mesh({0.04, 0.04}, 80, 80, 0.2, 3);
  const MeshPath path = path_on(mesh, 0.012, 0.0001, [](double s) {  // a half circle of 3 mm and a bit
    return Vector3d(0.02 + 0.003 * std::cos(s / 0.003), 0.02 + 0.003 * std::sin(s / 0.003), 0.0);
  });
  HapticCoordinatesConfig config;
  config.rings = 8;
  config.smoothing_mm = 0.5;
  const auto result = assign_haptic_coordinates(mesh, make_adjacency(mesh), {path}, config);
  EXPECT_FALSE(result.warps[0].stretched.empty());
  EXPECT_FALSE(result.warps[0].overlapping.empty());
  EXPECT_GT(result.warps[0].stretch_max, 2.0);
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
  const MeshPath path = path_on(mesh, 0.01, 0.0001, [](double s) { return Vector3d(0.005 + s, 0.0103, 0.0); });
  const auto result = assign_haptic_coordinates(mesh, make_adjacency(mesh), {path});
  for (std::size_t t = 0; t < 800; ++t) {
    if (result.triangles[t].texture < 0) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3d& p = mesh.vertices_m[mesh.triangles[t][k]];
      EXPECT_LT((result.triangles[t].xy_mm[k] - 1e3 * Vector2d(p.x() - 0.005, 0.0103 - p.y())).norm(), 1e-3);
    }
  }
}

TEST(HapticCoordinates, APathWithoutPointsGetsNoTriangles) {
  const TriangleMesh mesh = testkit::plane_mesh({0.02, 0.02}, 4, 4);
  const MeshPath good = path_on(mesh, 0.01, 0.001, [](double s) { return Vector3d(0.005 + s, 0.01, 0.0); });
  const auto result = assign_haptic_coordinates(mesh, make_adjacency(mesh), {MeshPath{}, good});
  for (const HapticTriangle& triangle : result.triangles) EXPECT_NE(triangle.texture, 1);
  EXPECT_GT(result.warps[1].triangles, 0u);
}

TEST(HapticCoordinates, RefuseBadPaths) {
  const TriangleMesh mesh = testkit::plane_mesh({0.02, 0.02}, 4, 4);
  const MeshAdjacency adjacency = make_adjacency(mesh);
  const MeshPath good = path_on(mesh, 0.01, 0.001, [](double s) { return Vector3d(0.005 + s, 0.01, 0.0); });
  const auto refused = [&](const std::function<void(MeshPath&)>& change) {
    MeshPath bad = good;
    change(bad);
    EXPECT_THROW(assign_haptic_coordinates(mesh, adjacency, {good, bad}), Error);
  };
  refused([](MeshPath& p) { p.s_m[3] = 0.0; });
  refused([](MeshPath& p) { p.s_m.pop_back(); });
  refused([](MeshPath& p) { p.triangle[2] = 32; });
  refused([](MeshPath& p) { p.p_mesh_m[2].y() = std::nan(""); });
  refused([](MeshPath& p) { std::fill(p.s_m.begin(), p.s_m.end(), 0.0); });
}

TEST(HapticCoordinates, APathWithoutPointsKeepsItsNumber) {
  const TriangleMesh mesh = testkit::plane_mesh({0.02, 0.01}, 20, 10, 0.0, 1);
  const MeshPath path = path_on(mesh, 0.01, 0.5e-3, [](double s_m) { return Vector3d(0.005 + s_m, 0.005, 0.0); });
  const HapticCoordinates both = assign_haptic_coordinates(mesh, make_adjacency(mesh), {MeshPath{}, path});
  ASSERT_EQ(both.warps.size(), 2u);
  EXPECT_EQ(both.warps[0].triangles, 0u);
  std::size_t second = 0;
  for (const HapticTriangle& triangle : both.triangles) {
    EXPECT_NE(triangle.texture, 1);
    second += triangle.texture == 2 ? 1 : 0;
  }
  EXPECT_EQ(second, both.warps[1].triangles);
}

}  // namespace
}  // namespace asperity
