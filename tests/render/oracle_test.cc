// The oracles of the renderer's tests, by brute force and closed forms: they share no code with what they judge.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Geometry>

#include "asperity/base/random.h"
#include "asperity/geometry/mesh_adjacency.h"
#include "asperity/geometry/mesh_bvh.h"
#include "asperity/testkit/ball_rest.h"
#include "asperity/testkit/bumpy_sphere.h"
#include "asperity/testkit/shape_meshes.h"
#include "asperity/testkit/tracked_minimum.h"
#include "asperity/testkit/wandering_path.h"

namespace asperity::testkit {
namespace {

using Eigen::Vector3d;

Vector3d random_vector(Random& random) { return {random.normal(), random.normal(), random.normal()}; }

TEST(BumpySphere, IsClosedStarShapedAndOfTheStatedSize) {
  const TriangleMesh mesh = bumpy_sphere_mesh(59);
  EXPECT_EQ(mesh.triangles.size(), 69620u);
  EXPECT_EQ(mesh.vertices_m.size(), 34812u);  // Euler: 10 f² + 2
  const MeshAdjacency adjacency = make_adjacency(mesh);
  for (std::uint32_t e = 0; e < adjacency.edge_vertices.size(); ++e) {
    ASSERT_EQ(adjacency.triangles_of_edge(e).size(), 2u);
  }
  double sum2 = 0.0;
  for (const Vector3d& p : mesh.vertices_m) sum2 += std::pow(p.norm() - 50e-3, 2);
  EXPECT_NEAR(std::sqrt(sum2 / static_cast<double>(mesh.vertices_m.size())), 0.35e-3, 0.05e-3);
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vector3d& p = mesh.vertices_m[a];
    ASSERT_GT((mesh.vertices_m[b] - p).cross(mesh.vertices_m[c] - p).dot(p), 0.0);
  }
}

TEST(NearestOfTriangle, IsNearerThanEveryOtherPoint) {
  Random random(1);
  for (int k = 0; k < 2000; ++k) {
    const Vector3d a = random_vector(random), b = random_vector(random), c = random_vector(random);
    const Vector3d p = 2.0 * random_vector(random);
    const Vector3d q = nearest_of_triangle(a, b, c, p).p_m;
    for (int i = 0; i < 20; ++i) {
      double u = random.uniform(), v = random.uniform();
      if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
      const Vector3d x = a + u * (b - a) + v * (c - a);
      // Nearest point of a convex set: no point of it is beyond the plane through q across p − q.
      EXPECT_LE((x - q).dot(p - q), 1e-12 * (1.0 + p.squaredNorm()));
    }
  }
}

TEST(TrackedMinimum, NoPlaceNearbyIsNearer) {
  const TriangleMesh mesh = bumpy_sphere_mesh(30);
  const MeshBvh bvh(mesh);
  const PressedPath path = press_into(bvh, wandering_directions(3000, 2e-3, 3), 0.0, 1e-3);
  TrackedMinimum minimum(mesh);
  Random random(7);
  for (std::size_t i = path.first_pressed; i < path.p_m.size(); ++i) {
    const Vector3d& p = path.p_m[i];
    const Vector3d x =
        (i == path.first_pressed ? minimum.start(bvh.closest_point(p).triangle, p) : minimum.follow(p)).p_m;
    ASSERT_LE(bvh.closest_point(x).distance_m, 1e-15);
    for (int k = 0; k < 10; ++k) {
      const Vector3d other = bvh.closest_point(x + 1e-10 * random_vector(random)).p_m;
      ASSERT_GE((other - p).norm(), (x - p).norm() * (1.0 - 1e-14));
    }
  }
}

TEST(TrackedMinimum, StaysOnItsSideOfAFoldUntilTheMinimumVanishes) {
  // A roof: x < 0 rises to the edge x = 0 with z = −|x|.
  const TriangleMesh roof{{{-1, -1, -1}, {0, -1, 0}, {1, -1, -1}, {-1, 1, -1}, {0, 1, 0}, {1, 1, -1}},
                          {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}}};
  TrackedMinimum minimum(roof);
  minimum.start(0, {-0.1, 0.0, -0.2});
  // The foot on the left side leaves it at x + z = 0.
  EXPECT_LT(minimum.follow({0.19, 0.0, -0.2}).p_m.x(), 0.0);
  EXPECT_GT(minimum.follow({0.201, 0.0, -0.2}).p_m.x(), 0.0);
}

TEST(NearestOfHalfSpaces, FulfilsTheConditionsOfAMinimum) {
  Random random(5);
  for (int k = 0; k < 3000; ++k) {
    const int count = 1 + static_cast<int>(random.uniform(0.0, 30.0));
    std::vector<HalfSpace> spaces;
    for (int i = 0; i < count; ++i) {
      // All hold the origin; some nearly parallel.
      Vector3d n = random_vector(random).normalized();
      if (i > 0 && random.chance(0.3)) n = (spaces.back().n + 1e-4 * n).normalized();
      spaces.push_back({n, -random.uniform()});
    }
    const Vector3d p = 5.0 * random_vector(random);
    const Vector3d x = nearest_of_half_spaces(p, spaces);
    for (const HalfSpace& space : spaces) EXPECT_GE(space.n.dot(x), space.b_m - 1e-9);
    // No feasible point is nearer: p − x makes no acute angle with the way to any of them.
    for (int i = 0; i < 200; ++i) {
      Vector3d y = x + std::pow(10.0, -random.uniform(0.0, 5.0)) * random_vector(random);
      const bool free =
          std::all_of(spaces.begin(), spaces.end(), [&](const HalfSpace& s) { return s.n.dot(y) >= s.b_m; });
      if (free) {
        EXPECT_LE((p - x).dot(y - x), 1e-8 * p.norm());
      }
    }
  }
}

TEST(BallRest, RestsOnTheOffsetOfASphere) {
  constexpr double kRadius_m = 20e-3, kTip_m = 2e-3;
  const TriangleMesh mesh = sphere_mesh(kRadius_m, 5);
  const MeshBvh bvh(mesh);
  Random random(2);
  for (int k = 0; k < 50; ++k) {
    const Vector3d u = random_vector(random).normalized();
    BallRest ball(mesh, bvh, kTip_m);
    const Vector3d p = (kRadius_m + kTip_m - 1e-3) * u;
    const Vector3d c = ball.descend((kRadius_m + 2.0 * kTip_m) * (u + 0.05 * random_vector(random)).normalized(), p);
    const double sagitta_m = 6e-6;  // of edges of up to 0.75 mm on 20 mm
    EXPECT_NEAR(c.norm(), kRadius_m + kTip_m, sagitta_m);
    const BallConditions at = ball_conditions(mesh, bvh, kTip_m, c, p);
    EXPECT_NEAR(at.distance_m, kTip_m, 1e-12);
    EXPECT_LE(at.residual_m, 1e-9);  // 1 µN at 1 N/mm
  }
}

TEST(BallRest, FulfilsTheConditionsOverBumps) {
  const TriangleMesh mesh = bumpy_sphere_mesh(30);
  const MeshBvh bvh(mesh);
  for (const double tip_m : {0.5e-3, 2e-3}) {
    const PressedPath path = press_into(bvh, wandering_directions(1000, 2e-3, 4), tip_m, 1e-3);
    BallRest ball(mesh, bvh, tip_m);
    ball.start(path.p_m.front());
    std::size_t resting = 0;
    for (std::size_t i = 0; i < path.p_m.size(); ++i) {
      const Vector3d c = ball.follow(path.p_m[i]);
      if (i < path.first_pressed || i % 5 != 0) continue;
      const BallConditions at = ball_conditions(mesh, bvh, tip_m, c, path.p_m[i]);
      ASSERT_GE(at.distance_m, tip_m * (1.0 - 1e-12));
      ASSERT_LE(at.residual_m, 1e-7);  // 0.1 mN; at a vanishing minimum the descent is slow
      ++resting;
    }
    EXPECT_GT(resting, 150u);
  }
}

}  // namespace
}  // namespace asperity::testkit
