#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include <Eigen/Geometry>

#include "asperity/base/error.h"
#include "asperity/registration/haptic_coordinates.h"
#include "asperity/testkit/shape_meshes.h"
#include "mesh_path_on.h"

// Which triangles get coordinates, of which path, and what is said of those that are torn or folded.

namespace asperity {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using std::numbers::pi;

TEST(HapticTriangles, AreThoseTouchedAndRingsOfThoseThatShareAVertex) {
  const TriangleMesh mesh = testkit::plane_mesh({0.02, 0.02}, 20, 20);
  const MeshAdjacency adjacency = make_adjacency(mesh);
  const MeshPath path = mesh_path_on(mesh, 0.003, 0.0001, [](double s) { return Vector3d(0.0082 + s, 0.0105, 0.0); });
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

TEST(HapticTriangles, OfAThinPlateAreOnItsFront) {
  const TriangleMesh mesh = testkit::box_mesh({0.03, 0.03, 0.0004}, 15);
  const MeshPath path = mesh_path_on(mesh, 0.01, 0.0001, [](double s) { return Vector3d(0.01 + s, 0.015, 0.0004); });
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

TEST(HapticTriangles, OfALoopTearBetweenItsEndsAlone) {
  const double radius_m = 0.01;
  constexpr int kAround = 40;
  const TriangleMesh mesh = testkit::cylinder_mesh(radius_m, 0.02, kAround, 13, 2.0 * pi, 4);
  const double around_m = 2.0 * kAround * radius_m * std::sin(pi / kAround);
  const MeshPath path = mesh_path_on(mesh, around_m, 0.0001, [&](double s) {
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

TEST(HapticTriangles, OfSeveralPathsAreTheNearestOnes) {
  const TriangleMesh mesh = testkit::plane_mesh({0.04, 0.04}, 40, 40, 0.2, 3);
  const MeshPath lower = mesh_path_on(mesh, 0.03, 0.0002, [](double s) { return Vector3d(0.005 + s, 0.015, 0.0); });
  const MeshPath upper = mesh_path_on(mesh, 0.03, 0.0002, [](double s) { return Vector3d(0.035 - s, 0.019, 0.0); });
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

TEST(HapticTriangles, FoldInsideATightBendAndItIsSaid) {
  const TriangleMesh mesh = testkit::plane_mesh({0.04, 0.04}, 80, 80, 0.2, 3);
  const MeshPath path = mesh_path_on(mesh, 0.012, 0.0001, [](double s) {  // a half circle of 3 mm and a bit
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

TEST(HapticTriangles, OfBadPathsAreRefused) {
  const TriangleMesh mesh = testkit::plane_mesh({0.02, 0.02}, 4, 4);
  const MeshAdjacency adjacency = make_adjacency(mesh);
  const MeshPath good = mesh_path_on(mesh, 0.01, 0.001, [](double s) { return Vector3d(0.005 + s, 0.01, 0.0); });
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

TEST(HapticTriangles, APathWithoutPointsKeepsItsNumber) {
  const TriangleMesh mesh = testkit::plane_mesh({0.02, 0.01}, 20, 10, 0.0, 1);
  const MeshPath path = mesh_path_on(mesh, 0.01, 0.5e-3, [](double s_m) { return Vector3d(0.005 + s_m, 0.005, 0.0); });
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
