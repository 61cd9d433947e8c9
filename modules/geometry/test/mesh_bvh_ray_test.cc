#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "asperity/geometry/mesh_bvh.h"
#include "bvh_meshes.h"
#include "mesh_bvh_tree.h"

namespace asperity {
namespace {

using Eigen::Vector3d;
using Vector3l = Eigen::Matrix<long double, 3, 1>;

// t of the hit with one triangle in 80 bits, or infinity; `clear`: by how much of the triangle the ray keeps off its
// edges, so that rounding cannot tell otherwise.
long double hit(const TriangleMesh& mesh, std::size_t triangle, const Vector3d& origin, const Vector3d& direction,
                long double& clear) {
  Vector3l v[3];
  for (std::size_t k = 0; k < 3; ++k)
    v[k] = (mesh.vertices_m[mesh.triangles[triangle][k]].cast<long double>() - origin.cast<long double>()).eval();
  const Vector3l d = direction.cast<long double>();
  const Vector3l n = (v[1] - v[0]).cross(v[2] - v[0]);
  clear = 1.0L;
  if (n.dot(d) == 0.0L) return std::numeric_limits<long double>::infinity();
  const long double w[3] = {d.dot(v[1].cross(v[2])) / d.dot(n), d.dot(v[2].cross(v[0])) / d.dot(n),
                            d.dot(v[0].cross(v[1])) / d.dot(n)};
  const long double least = std::min({w[0], w[1], w[2]}), t = n.dot(v[0]) / n.dot(d);
  clear = std::min(std::abs(least), std::abs(t));
  return least >= 0.0L && t >= 0.0L ? t : std::numeric_limits<long double>::infinity();
}

TEST(MeshBvhRay, FirstHitIsThatOfBruteForce) {
  for (const auto& named : {test::NamedMesh{"soup", test::soup(600, 0.2, 31)},
                            {"sphere", test::sphere(16, 30)},
                            {"square", test::square(20)},
                            {"tiny", test::moved(test::soup(400, 0.3, 32), 1e-6, {0, 0, 0}), 1e-6}}) {
    MeshBvh bvh(named.mesh);
    for (const auto* kernels : supported_kernels()) {
      MeshBvhAccess::use(bvh, *kernels);
      Random random(33);
      for (int i = 0; i < 300; ++i) {
        const Vector3d origin = named.scale * test::random_point(random, i % 3 == 0 ? 50.0 : 1.5);
        const Vector3d direction = i % 3 == 0 ? Vector3d(named.scale * test::random_point(random, 1.0) - origin)
                                              : test::random_point(random, std::pow(10.0, random.uniform(-8.0, 8.0)));
        long double expected = std::numeric_limits<long double>::infinity(), clear = 1.0L;
        for (std::size_t k = 0; k < named.mesh.triangles.size(); ++k) {
          long double one = 1.0L;
          expected = std::min(expected, hit(named.mesh, k, origin, direction, one));
          clear = std::min(clear, one);
        }
        if (clear < 1e-10L) continue;  // too close to an edge for two ways to agree
        const RayHit found = bvh.cast_ray(origin, direction);
        ASSERT_EQ(found.found(), std::isfinite(expected)) << named.name << " ray " << i;
        if (!found.found()) continue;
        ASSERT_NEAR(found.t / static_cast<double>(expected), 1.0, 1e-10);
        const auto& t = named.mesh.triangles[found.triangle];
        Vector3d at = Vector3d::Zero();
        for (int k = 0; k < 3; ++k) at += found.barycentric[k] * named.mesh.vertices_m[t[static_cast<std::size_t>(k)]];
        ASSERT_NEAR((at - origin - found.t * direction).norm(), 0.0, 1e-13 * (origin.norm() + named.scale));
        ASSERT_TRUE(bvh.cast_ray(origin, direction, found.t).found());
        ASSERT_FALSE(bvh.cast_ray(origin, direction, std::nextafter(found.t, 0.0)).triangle == found.triangle);
      }
    }
  }
}

// From inside a closed mesh every ray hits, above all those through edges and corners.
TEST(MeshBvhRay, NoneSlipsThroughEdgesAndCorners) {
  for (const double scale : {1.0, 1e-6, 1e6}) {
    const TriangleMesh mesh = test::moved(test::sphere(16, 24), scale, {0.0, 0.0, 0.0});
    MeshBvh bvh(mesh);
    for (const auto* kernels : supported_kernels()) {
      MeshBvhAccess::use(bvh, *kernels);
      Random random(34);
      for (const auto& t : mesh.triangles)
        for (int i = 0; i < 6; ++i) {
          const Vector3d origin = scale * test::random_point(random, 0.3);
          const Vector3d &a = mesh.vertices_m[t[static_cast<std::size_t>(i % 3)]],
                         &b = mesh.vertices_m[t[static_cast<std::size_t>((i + 1) % 3)]];
          const Vector3d target = i < 3 ? a : Vector3d(a + random.uniform() * (b - a));
          const RayHit found = bvh.cast_ray(origin, target - origin);
          ASSERT_TRUE(found.found());
          ASSERT_NEAR(found.t, 1.0, 1e-12);
        }
    }
  }
}

// Rays along the axes through the corners and edges of a grid, where float and double agree exactly on ties.
TEST(MeshBvhRay, GridLinesAreHitFromBothSidesAndTiesGoToTheSmallestIndex) {
  const TriangleMesh mesh = test::square(8);
  const MeshBvh bvh(mesh);
  for (std::uint32_t v = 0; v < mesh.vertices_m.size(); ++v)
    for (const double side : {1.0, -1.0}) {
      const Vector3d origin = mesh.vertices_m[v] + Vector3d(0.0, 0.0, 2.0 * side);
      const RayHit found = bvh.cast_ray(origin, {0.0, 0.0, -side});
      std::uint32_t first = 0;
      while (std::find(mesh.triangles[first].begin(), mesh.triangles[first].end(), v) == mesh.triangles[first].end())
        ++first;
      EXPECT_EQ(found.triangle, first);
      EXPECT_EQ(found.t, 2.0);
      EXPECT_FALSE(bvh.cast_ray(origin, {0.0, 0.0, side}).found());
      EXPECT_FALSE(bvh.cast_ray(origin, {0.0, 0.0, -side}, 1.99).found());
    }
}

TEST(MeshBvhRay, FarOriginsArriveAndPowersOfTwoScaleBitForBit) {
  const TriangleMesh mesh = test::sphere(16, 24);
  const MeshBvh bvh(mesh), scaled(test::moved(mesh, 0x1p-40, Vector3d::Zero()));
  Random random(35);
  for (int i = 0; i < 300; ++i) {
    const Vector3d origin = std::pow(10.0, random.uniform(0.5, 8.0)) * test::random_point(random, 1.0).normalized();
    const Vector3d direction = test::random_point(random, 0.3) - origin;
    const RayHit found = bvh.cast_ray(origin, direction), small = scaled.cast_ray(0x1p-40 * origin, 8.0 * direction);
    ASSERT_TRUE(found.found());
    EXPECT_EQ(found.triangle, small.triangle);
    EXPECT_EQ(found.t, small.t * 0x1p43);
    EXPECT_EQ(found.barycentric, small.barycentric);
  }
}

TEST(MeshBvhRay, WhatIsNoRayHitsNothing) {
  const MeshBvh bvh(test::sphere(8, 8));
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInf = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(bvh.cast_ray({0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}).found());
  for (const double bad : {kNan, kInf}) {
    EXPECT_FALSE(bvh.cast_ray({0.0, bad, 0.0}, {1.0, 0.0, 0.0}).found());
    EXPECT_FALSE(bvh.cast_ray({0.0, 0.0, 0.0}, {1.0, bad, 0.0}).found());
  }
  EXPECT_FALSE(bvh.cast_ray({0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, kNan).found());
  EXPECT_FALSE(bvh.cast_ray({0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, -1.0).found());
}

}  // namespace
}  // namespace asperity
