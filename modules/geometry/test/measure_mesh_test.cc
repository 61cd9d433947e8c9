// The numbers of a mesh, by closed forms.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "asperity/base/error.h"
#include "asperity/geometry/mesh_measures.h"

namespace asperity {
namespace {

using Eigen::Vector3d;

constexpr double kRounding = 1e-12;  // relative: some hundred roundings of 1e-16

TriangleMesh cube(double side_m) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.vertices_m.push_back(side_m * Vector3d(double(i & 1), double(i >> 1 & 1), double(i >> 2 & 1)));
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

// Every triangle with vertices of its own, as in an STL file.
TriangleMesh soup(const TriangleMesh& mesh) {
  TriangleMesh out;
  for (const Triangle& triangle : mesh.triangles) {
    const auto first = static_cast<std::uint32_t>(out.vertices_m.size());
    for (const std::uint32_t v : triangle) out.vertices_m.push_back(mesh.vertices_m[v]);
    out.triangles.push_back({first, first + 1, first + 2});
  }
  return out;
}

void add(TriangleMesh& mesh, const TriangleMesh& other, const Vector3d& shift_m) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices_m.size());
  for (const Vector3d& p_m : other.vertices_m) mesh.vertices_m.emplace_back(p_m + shift_m);
  for (const Triangle& t : other.triangles) mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
}

// A sphere of rings and sectors.
TriangleMesh sphere(double radius_m, std::uint32_t rings, std::uint32_t sectors) {
  TriangleMesh mesh;
  mesh.vertices_m.emplace_back(0.0, 0.0, radius_m);
  for (std::uint32_t i = 1; i < rings; ++i) {
    const double polar = std::numbers::pi * i / rings;
    for (std::uint32_t k = 0; k < sectors; ++k) {
      const double round = 2.0 * std::numbers::pi * k / sectors;
      mesh.vertices_m.emplace_back(
          radius_m * Vector3d(std::sin(polar) * std::cos(round), std::sin(polar) * std::sin(round), std::cos(polar)));
    }
  }
  mesh.vertices_m.emplace_back(0.0, 0.0, -radius_m);
  const auto last = static_cast<std::uint32_t>(mesh.vertices_m.size() - 1);
  const auto at = [&](std::uint32_t ring, std::uint32_t k) { return 1 + (ring - 1) * sectors + k % sectors; };
  for (std::uint32_t k = 0; k < sectors; ++k) {
    mesh.triangles.push_back({0, at(1, k), at(1, k + 1)});
    for (std::uint32_t i = 1; i + 1 < rings; ++i) {
      mesh.triangles.push_back({at(i, k), at(i + 1, k), at(i + 1, k + 1)});
      mesh.triangles.push_back({at(i, k), at(i + 1, k + 1), at(i, k + 1)});
    }
    mesh.triangles.push_back({at(rings - 1, k), last, at(rings - 1, k + 1)});
  }
  return mesh;
}

TEST(MeasureMesh, ACubeHasSixFacesAndACubesVolume) {
  const double side_m = 0.03;
  for (const TriangleMesh& mesh : {cube(side_m), soup(cube(side_m))}) {
    const MeshMeasures found = measure_mesh(mesh);
    EXPECT_EQ(found.triangles, 12U);
    EXPECT_EQ(found.vertices, 8U);
    EXPECT_EQ(found.edges, 18U);
    EXPECT_EQ(found.parts, 1U);
    EXPECT_TRUE(found.closed());
    EXPECT_EQ(found.high_m, Vector3d::Constant(side_m));
    EXPECT_NEAR(found.area_m2, 6.0 * side_m * side_m, kRounding * found.area_m2);
    ASSERT_TRUE(found.volume_m3);
    EXPECT_NEAR(*found.volume_m3, side_m * side_m * side_m, kRounding * *found.volume_m3);
    EXPECT_EQ(found.shortest_edge_m, side_m);
    EXPECT_EQ(found.median_edge_m, side_m);  // 12 sides, 6 diagonals
    EXPECT_NEAR(found.longest_edge_m, side_m * std::numbers::sqrt2, kRounding * side_m);
    EXPECT_EQ(found.non_manifold_edges + found.non_manifold_vertices + found.flipped_edges + found.degenerate_triangles,
              0U);
  }
}

TEST(MeasureMesh, ARegularTetrahedronFarFromTheOriginHasItsClosedForms) {
  const double side_m = 0.02;
  const double half_m = side_m / (2.0 * std::numbers::sqrt2);
  TriangleMesh mesh;
  for (const Vector3d& corner : {Vector3d(1, 1, 1), Vector3d(1, -1, -1), Vector3d(-1, 1, -1), Vector3d(-1, -1, 1)})
    mesh.vertices_m.emplace_back(half_m * corner + Vector3d(10.0, -20.0, 30.0));
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}};
  // Ten metres away a coordinate is rounded by 4e-15 m: 2e-13 of the side, some times that of area and volume.
  const double kFar = 4e-12;
  const MeshMeasures found = measure_mesh(mesh);
  EXPECT_NEAR(found.area_m2, std::numbers::sqrt3 * side_m * side_m, kFar * found.area_m2);
  ASSERT_TRUE(found.volume_m3);
  EXPECT_NEAR(*found.volume_m3, side_m * side_m * side_m / (6.0 * std::numbers::sqrt2), kFar * *found.volume_m3);
  EXPECT_NEAR(found.shortest_edge_m, side_m, kFar * side_m);
  EXPECT_NEAR(found.longest_edge_m, side_m, kFar * side_m);
  EXPECT_EQ(found.edges, 6U);
}

TEST(MeasureMesh, TwoSpheresAreTwoPartsWithTheVolumeOfBoth) {
  TriangleMesh mesh = sphere(0.01, 200, 400);
  add(mesh, sphere(0.005, 200, 400), Vector3d(0.05, 0.0, 0.0));
  const MeshMeasures found = measure_mesh(mesh);
  EXPECT_EQ(found.parts, 2U);
  EXPECT_TRUE(found.closed());
  EXPECT_EQ(found.vertices - found.edges + found.triangles, 4U);  // Euler: 2 a sphere
  const double area_m2 = 4.0 * std::numbers::pi * (1e-4 + 2.5e-5);
  const double volume_m3 = 4.0 / 3.0 * std::numbers::pi * (1e-6 + 1.25e-7);
  // The chords of steps of π/200 are inside by (π/200)²/2 = 1.2e-4 of area and volume at most.
  EXPECT_NEAR(found.area_m2, area_m2, 1.3e-4 * area_m2);
  EXPECT_LT(found.area_m2, area_m2);
  ASSERT_TRUE(found.volume_m3);
  EXPECT_NEAR(*found.volume_m3, volume_m3, 2.5e-4 * volume_m3);
  EXPECT_LT(*found.volume_m3, volume_m3);
}

TEST(MeasureMesh, ACavityIsTakenOff) {
  TriangleMesh mesh = cube(0.04), inner = cube(0.02);
  for (Triangle& triangle : inner.triangles) std::swap(triangle[1], triangle[2]);
  add(mesh, inner, Vector3d::Constant(0.01));
  ASSERT_TRUE(measure_mesh(mesh).volume_m3);
  EXPECT_NEAR(*measure_mesh(mesh).volume_m3, 6.4e-5 - 8e-6, 1e-16);
}

TEST(MeasureMesh, AnOpenSheetHasItsBorderAndNoVolume) {
  TriangleMesh mesh;  // 4 by 3 squares of 1 mm
  for (int y = 0; y <= 3; ++y) {
    for (int x = 0; x <= 4; ++x) mesh.vertices_m.emplace_back(1e-3 * x, 1e-3 * y, 0.0);
  }
  for (std::uint32_t y = 0; y < 3; ++y) {
    for (std::uint32_t x = 0; x < 4; ++x) {
      const std::uint32_t a = 5 * y + x;
      mesh.triangles.push_back({a, a + 1, a + 6});
      mesh.triangles.push_back({a, a + 6, a + 5});
    }
  }
  const MeshMeasures found = measure_mesh(mesh);
  EXPECT_FALSE(found.closed());
  EXPECT_FALSE(found.volume_m3);
  EXPECT_EQ(found.open_edges, 14U);  // 2 (4 + 3)
  EXPECT_EQ(found.edges, 43U);       // 4·4 + 3·5 along the squares' sides, 12 diagonals
  EXPECT_NEAR(found.area_m2, 12e-6, 1e-18);
  EXPECT_EQ(found.non_manifold_edges + found.non_manifold_vertices, 0U);
}

TEST(MeasureMesh, FaultsAreCounted) {
  TriangleMesh flipped = cube(1.0);
  std::swap(flipped.triangles[0][1], flipped.triangles[0][2]);
  EXPECT_EQ(measure_mesh(flipped).flipped_edges, 3U);
  EXPECT_TRUE(measure_mesh(flipped).closed());
  EXPECT_FALSE(measure_mesh(flipped).volume_m3);

  TriangleMesh fin = cube(1.0);  // a third triangle at one edge
  fin.vertices_m.emplace_back(0.5, -1.0, -1.0);
  fin.triangles.push_back({0, 1, 8});
  EXPECT_EQ(measure_mesh(fin).non_manifold_edges, 1U);
  EXPECT_EQ(measure_mesh(fin).open_edges, 2U);

  TriangleMesh hourglass = cube(1.0);  // two cubes that meet at a corner
  add(hourglass, cube(1.0), Vector3d::Ones());
  EXPECT_EQ(measure_mesh(hourglass).non_manifold_vertices, 1U);
  EXPECT_EQ(measure_mesh(hourglass).non_manifold_edges, 0U);
  EXPECT_EQ(measure_mesh(hourglass).parts, 1U);

  TriangleMesh line = cube(1.0);  // corners on a line, and a corner named twice
  line.vertices_m.emplace_back(0.5, 0.0, 0.0);
  line.triangles.push_back({0, 8, 1});
  line.triangles.push_back({2, 2, 3});
  EXPECT_EQ(measure_mesh(line).degenerate_triangles, 2U);
}

TEST(MeasureMesh, NothingHasNoNumbersAndWrongIndicesAreRefused) {
  const MeshMeasures none = measure_mesh({});
  EXPECT_EQ(none.triangles + none.vertices + none.edges + none.parts, 0U);
  EXPECT_FALSE(none.closed());
  TriangleMesh wrong = cube(1.0);
  wrong.triangles.push_back({0, 1, 99});
  EXPECT_THROW(measure_mesh(wrong), Error);
}

TEST(MeasureMesh, CanBeStopped) {
  TriangleMesh mesh;
  mesh.vertices_m = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}};
  mesh.triangles = {{0, 1, 2}};
  int asked = 0;
  measure_mesh(mesh, {{}, [&] { return ++asked < 0; }});
  ASSERT_GE(asked, 5);
  for (int last = 1; last <= asked; ++last) {
    int again = 0;
    EXPECT_THROW(measure_mesh(mesh, {{}, [&] { return ++again == last; }}), Cancelled) << last;
  }
}

}  // namespace
}  // namespace asperity
