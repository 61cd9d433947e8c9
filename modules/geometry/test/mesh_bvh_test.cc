#include "asperity/geometry/mesh_bvh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "asperity/base/error.h"
#include "asperity/geometry/nearest_on_triangle.h"
#include "brute_force.h"
#include "bvh_meshes.h"
#include "mesh_bvh_tree.h"

namespace asperity {
namespace {

using Eigen::Vector3d;

struct TestIsa {};

// The answer by the rule: of all triangles the least squared distance in double, then the smallest index. The
// distances are those of the code under test, which another test compares with more bits; this one is for ties.
struct Ruled {
  double distance2 = std::numeric_limits<double>::infinity();
  std::uint32_t triangle = 0;
};
Ruled by_rule(const TriangleMesh& mesh, const Vector3d& p) {
  Ruled best;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    std::array<const Vector3d*, 3> v;
    for (std::size_t k = 0; k < 3; ++k) v[k] = &mesh.vertices_m[mesh.triangles[i][k]];
    std::sort(v.begin(), v.end(), [](const Vector3d* a, const Vector3d* b) {
      return std::lexicographical_compare(a->begin(), a->end(), b->begin(), b->end());
    });
    const double d2 = bvh::nearest_on_triangle<TestIsa>(v[0]->data(), v[1]->data(), v[2]->data(), p.data()).distance2;
    if (d2 < best.distance2) best = {d2, i};
  }
  return best;
}

bool same(const ClosestPoint& a, const ClosestPoint& b) {
  return a.triangle == b.triangle && a.distance_m == b.distance_m && a.p_m == b.p_m && a.barycentric == b.barycentric;
}

TEST(MeshBvh, NearestIsThatOfBruteForceInMoreBits) {
  for (const auto& named : test::all_meshes()) {
    const MeshBvh bvh(named.mesh);
    const double size = named.scale + named.offset.norm();
    for (const Vector3d& p : test::query_points(named, 160, 11)) {
      const ClosestPoint nearest = bvh.closest_point(p);
      ASSERT_TRUE(nearest.found()) << named.name;
      const double expected = static_cast<double>(test::mesh_distance(named.mesh, p));
      // A few roundings of the distance and of the triangle's size; of the coordinates for the point itself.
      const double tolerance = 2e-15 * (expected + 2.0 * named.scale);
      ASSERT_NEAR(nearest.distance_m, expected, tolerance) << named.name << " at " << p.transpose();
      ASSERT_NEAR(static_cast<double>(test::triangle_distance(named.mesh, nearest.triangle, p)), expected, tolerance);
      ASSERT_NEAR((nearest.p_m - p).norm(), nearest.distance_m, tolerance + 1e-15 * size) << named.name;
      const auto& t = named.mesh.triangles[nearest.triangle];
      const Vector3d at = nearest.barycentric[0] * named.mesh.vertices_m[t[0]] +
                          nearest.barycentric[1] * named.mesh.vertices_m[t[1]] +
                          nearest.barycentric[2] * named.mesh.vertices_m[t[2]];
      ASSERT_NEAR((at - nearest.p_m).norm(), 0.0, 2e-15 * size) << named.name;
      ASSERT_NEAR(nearest.barycentric.sum(), 1.0, 1e-15);
      ASSERT_GE(nearest.barycentric.minCoeff(), -1e-16);
    }
  }
}

TEST(MeshBvh, TiesGoToTheSmallestIndexWithEveryInstructionSet) {
  for (auto& named : test::all_meshes()) {
    MeshBvh bvh(named.mesh);
    for (const auto* kernels : supported_kernels()) {
      MeshBvhAccess::use(bvh, *kernels);
      for (const Vector3d& p : test::query_points(named, 200, 12)) {
        const Ruled expected = by_rule(named.mesh, p);
        const ClosestPoint nearest = bvh.closest_point(p);
        ASSERT_EQ(nearest.triangle, expected.triangle) << named.name << " at " << p.transpose();
        ASSERT_EQ(nearest.distance_m, std::sqrt(expected.distance2)) << named.name;
      }
    }
  }
}

TEST(MeshBvh, NeighboursAreExactlyAsFarFromTheirCommonEdgesAndCorners) {
  const TriangleMesh mesh = test::sphere(20, 30);
  const MeshBvh bvh(mesh);
  for (std::uint32_t v = 0; v < mesh.vertices_m.size(); ++v) {
    std::uint32_t first = 0;
    while (std::find(mesh.triangles[first].begin(), mesh.triangles[first].end(), v) == mesh.triangles[first].end())
      ++first;
    for (const double height : {0.0, 1e-9, 1e-3, 5.0}) {
      const ClosestPoint nearest = bvh.closest_point((1.0 + height) * mesh.vertices_m[v]);
      EXPECT_EQ(nearest.triangle, first);
      EXPECT_EQ(nearest.p_m, mesh.vertices_m[v]);
    }
  }
}

TEST(MeshBvh, InstructionSetsAndWarmStartsGiveTheSameBits) {
  for (const auto& named : test::all_meshes()) {
    MeshBvh bvh(named.mesh);
    Random random(13);
    const auto points = test::query_points(named, 1500, 14);
    std::vector<ClosestPoint> cold;
    for (const auto* kernels : supported_kernels()) {
      MeshBvhAccess::use(bvh, *kernels);
      for (std::size_t i = 0; i < points.size(); ++i) {
        const ClosestPoint nearest = bvh.closest_point(points[i]);
        if (cold.size() < points.size()) cold.push_back(nearest);
        ASSERT_TRUE(same(nearest, cold[i])) << named.name;
        // Answers for other points, and answers that are none.
        const ClosestPoint& other = cold[static_cast<std::size_t>(random.uniform() * static_cast<double>(i + 1))];
        ASSERT_TRUE(same(bvh.closest_point(points[i], other), cold[i])) << named.name;
        ClosestPoint wrong = cold[i];
        wrong.triangle = static_cast<std::uint32_t>(random.bits() % (2 * named.mesh.triangles.size()));
        wrong.distance_m = 0.0;
        wrong.p_m = points[i];
        ASSERT_TRUE(same(bvh.closest_point(points[i], wrong), cold[i])) << named.name;
        ASSERT_TRUE(same(bvh.closest_point(points[i], ClosestPoint{}), cold[i])) << named.name;
      }
    }
  }
}

TEST(MeshBvh, PowersOfTwoScaleTheAnswerBitForBit) {
  for (const auto& named : test::all_meshes()) {
    const MeshBvh bvh(named.mesh);
    for (const double scale : {0x1p-300, 0x1p-20, 0x1p-1, 0x1p19, 0x1p300}) {
      const MeshBvh scaled(test::moved(named.mesh, scale, Vector3d::Zero()));
      for (const Vector3d& p : test::query_points(named, 200, 15)) {
        const ClosestPoint a = bvh.closest_point(p), b = scaled.closest_point(scale * p);
        ASSERT_EQ(a.triangle, b.triangle) << named.name;
        ASSERT_EQ(scale * a.distance_m, b.distance_m) << named.name;
        ASSERT_EQ(scale * a.p_m, b.p_m);
        ASSERT_EQ(a.barycentric, b.barycentric);
      }
    }
  }
}

TEST(MeshBvh, RadiusIsInclusiveAndNothingBeyondIsFound) {
  const auto named = test::NamedMesh{"soup", test::soup(500, 0.1, 20)};
  const MeshBvh bvh(named.mesh);
  for (const Vector3d& p : test::query_points(named, 500, 21)) {
    const ClosestPoint nearest = bvh.closest_point(p);
    const double d = nearest.distance_m;
    EXPECT_TRUE(same(bvh.closest_point(p, d), nearest));
    EXPECT_TRUE(same(bvh.closest_point(p, 2.0 * d), nearest));
    EXPECT_FALSE(d > 0.0 && bvh.closest_point(p, std::nextafter(d, 0.0)).found());
  }
}

TEST(MeshBvh, TrianglesWithinARadiusAreThoseOfBruteForce) {
  for (const auto& named : test::all_meshes()) {
    MeshBvh bvh(named.mesh);
    Random random(22);
    for (const auto* kernels : supported_kernels()) {
      MeshBvhAccess::use(bvh, *kernels);
      for (const Vector3d& p : test::query_points(named, 32, 23)) {
        const double radius = static_cast<double>(test::mesh_distance(named.mesh, p)) + named.scale * random.uniform();
        std::vector<std::uint32_t> found(named.mesh.triangles.size()), expected;
        const std::size_t count = bvh.triangles_within(p, radius, found);
        ASSERT_LE(count, found.size());
        found.resize(count);
        for (std::uint32_t i = 0; i < named.mesh.triangles.size(); ++i)
          if (static_cast<double>(test::triangle_distance(named.mesh, i, p)) <= radius) expected.push_back(i);
        ASSERT_THAT(found, testing::UnorderedElementsAreArray(expected)) << named.name;
        std::array<std::uint32_t, 1> one{};
        ASSERT_EQ(bvh.triangles_within(p, radius, one), count);
      }
    }
  }
}

TEST(MeshBvh, WhatIsNoPointIsNotFound) {
  const MeshBvh bvh(test::sphere(8, 8));
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInf = std::numeric_limits<double>::infinity();
  for (const double bad : {kNan, kInf, -kInf}) {
    EXPECT_FALSE(bvh.closest_point({0.0, bad, 0.0}).found());
    EXPECT_FALSE(bvh.closest_point({0.0, bad, 0.0}, ClosestPoint{}).found());
    EXPECT_EQ(bvh.triangles_within({0.0, bad, 0.0}, 1.0, {}), 0u);
  }
  EXPECT_FALSE(bvh.closest_point({0.0, 0.0, 0.0}, kNan).found());
  EXPECT_FALSE(bvh.closest_point({0.0, 0.0, 0.0}, -1.0).found());
}

TEST(MeshBvh, PointsAtTheEndOfTheNumbersAreFound) {
  const MeshBvh bvh(test::sphere(8, 8));
  for (const double x : {1e10, 1e20, 1e40, 1e200, 1e300}) {
    const ClosestPoint nearest = bvh.closest_point({x, 0.0, 0.0});
    ASSERT_TRUE(nearest.found());
    EXPECT_NEAR(nearest.distance_m / x, 1.0, 2e-10);
    EXPECT_FALSE(bvh.closest_point({x, 0.0, 0.0}, 0.5 * x).found());
  }
}

TEST(MeshBvh, RefusesWhatIsNoMesh) {
  const auto message = [](const TriangleMesh& mesh) -> std::string {
    try {
      MeshBvh bvh(mesh);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(message({}), testing::HasSubstr("no triangles"));
  EXPECT_THAT(message({{{0.0, 0.0, 0.0}}, {{0, 0, 7}}}),
              testing::HasSubstr("triangle 0 of the mesh names vertex 7 of 1"));
  EXPECT_THAT(message({{{0.0, 0.0, 0.0}, {0.0, std::nan(""), 0.0}}, {{0, 0, 0}}}),
              testing::HasSubstr("vertex 1 of the mesh is not finite"));
}

}  // namespace
}  // namespace asperity
