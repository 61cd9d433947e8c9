#include "asperity/geometry/mesh_surface.h"

#include <cmath>
#include <map>
#include <utility>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "asperity/base/random.h"
#include "asperity/geometry/corner_normals.h"

namespace asperity {
namespace {

using Eigen::Vector3d;

// A sphere: an octahedron whose triangles are split in four `levels` times.
TriangleMesh sphere(double radius_m, int levels) {
  TriangleMesh mesh;
  mesh.vertices_m = {Vector3d::UnitX(),  -Vector3d::UnitX(), Vector3d::UnitY(),
                     -Vector3d::UnitY(), Vector3d::UnitZ(),  -Vector3d::UnitZ()};
  mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    std::vector<Triangle> finer;
    for (const Triangle& t : mesh.triangles) {
      Triangle middle{};
      for (std::size_t e = 0; e < 3; ++e) {
        const auto key = std::minmax(t[e], t[(e + 1) % 3]);
        const auto [at, is_new] = middles.try_emplace(key, static_cast<std::uint32_t>(mesh.vertices_m.size()));
        if (is_new) mesh.vertices_m.push_back((mesh.vertices_m[key.first] + mesh.vertices_m[key.second]).normalized());
        middle[e] = at->second;
      }
      finer.insert(finer.end(), {{t[0], middle[0], middle[2]},
                                 {t[1], middle[1], middle[0]},
                                 {t[2], middle[2], middle[1]},
                                 {middle[0], middle[1], middle[2]}});
    }
    mesh.triangles = finer;
  }
  for (Vector3d& v : mesh.vertices_m) v *= radius_m;
  return mesh;
}

TriangleMesh box(const Vector3d& size_m) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.vertices_m.emplace_back(size_m.x() * (i & 1), size_m.y() * ((i >> 1) & 1), size_m.z() * ((i >> 2) & 1));
  }
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

Vector3d random_barycentric(Random& random) {
  const double r = std::sqrt(random.uniform()), u = random.uniform();
  return {1.0 - r, r * (1.0 - u), r * u};
}

TEST(FootAlongNormal, UndoesADisplacementAlongTheNormals) {
  constexpr double kRadius_m = 0.05;
  constexpr double kRounding_m = 1e-13;  // positions of 0.05 m have an ulp of 7e-18; Newton's last step
  const MeshSurface surface(sphere(kRadius_m, 3));
  Random random(7);
  for (int trial = 0; trial < 2000; ++trial) {
    const auto triangle =
        static_cast<std::uint32_t>(random.uniform() * static_cast<double>(surface.mesh.triangles.size()));
    const Vector3d w = random_barycentric(random);
    Vector3d foot_m = Vector3d::Zero(), normal = Vector3d::Zero();
    for (std::size_t k = 0; k < 3; ++k) {
      foot_m += w[static_cast<Eigen::Index>(k)] * surface.mesh.vertices_m[surface.mesh.triangles[triangle][k]];
      normal += w[static_cast<Eigen::Index>(k)] * surface.normals[triangle][k];
    }
    normal.normalize();
    const double height_m = (random.uniform() - 0.5) * 4e-3;
    const Vector3d p_m = foot_m + height_m * normal;
    const NormalFoot foot = foot_along_normal(surface, p_m, surface.bvh.closest_point(p_m));
    ASSERT_TRUE(foot.on_normal) << trial;
    EXPECT_NEAR((foot.p_m - foot_m).norm(), 0.0, kRounding_m);
    EXPECT_NEAR(foot.height_m, height_m, kRounding_m);
    EXPECT_NEAR((foot.normal - normal).norm(), 0.0, 1e-9);
  }
}

TEST(FootAlongNormal, GoesSmoothlyOverEdgesWhereTheClosestPointHalts) {
  const MeshSurface surface(sphere(0.05, 2));
  // A circle 1 mm above the sphere: the closest point rests on each edge that it comes to, the foot does not.
  double least_m = 1.0, most_m = 0.0;
  Vector3d before = Vector3d::Zero();
  constexpr int kSteps = 4000;
  for (int i = 0; i <= kSteps; ++i) {
    const double angle = 2.0 * 3.14159265358979 * i / kSteps;
    const Vector3d p_m = 0.051 * Vector3d(std::cos(angle), std::sin(angle) * 0.8, std::sin(angle) * 0.6);
    const NormalFoot foot = foot_along_normal(surface, p_m, surface.bvh.closest_point(p_m));
    ASSERT_TRUE(foot.on_normal);
    if (i > 0) {
      const double step_m = (foot.p_m - before).norm();
      least_m = std::min(least_m, step_m);
      most_m = std::max(most_m, step_m);
    }
    before = foot.p_m;
  }
  EXPECT_GT(least_m, 0.85 * most_m);  // facets of 22° between them stretch the steps by some 5 %
}

TEST(FootAlongNormal, OnABoxTheNormalsAreTheFaces) {
  const MeshSurface surface(box({0.1, 0.06, 0.03}));
  Random random(3);
  for (int trial = 0; trial < 500; ++trial) {
    const Vector3d p_m(0.1 * random.uniform(), 0.06 * random.uniform(), 0.031);
    const NormalFoot foot = foot_along_normal(surface, p_m, surface.bvh.closest_point(p_m));
    ASSERT_TRUE(foot.on_normal);
    EXPECT_NEAR((foot.normal - Vector3d::UnitZ()).norm(), 0.0, 1e-15);
    EXPECT_NEAR(foot.height_m, 1e-3, 1e-16);
    EXPECT_NEAR((foot.p_m - Vector3d(p_m.x(), p_m.y(), 0.03)).norm(), 0.0, 1e-15);
  }
}

TEST(FootAlongNormal, BeyondABorderItIsTheClosestPointAndSaysSo) {
  TriangleMesh square;
  square.vertices_m = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  square.triangles = {{0, 1, 2}, {0, 2, 3}};
  const MeshSurface surface(square);
  const Vector3d p_m(1.5, 0.25, 0.5);
  const NormalFoot foot = foot_along_normal(surface, p_m, surface.bvh.closest_point(p_m));
  EXPECT_FALSE(foot.on_normal);
  EXPECT_NEAR((foot.p_m - Vector3d(1.0, 0.25, 0.0)).norm(), 0.0, 1e-15);
  EXPECT_NEAR(foot.height_m, 0.5, 1e-15);
}

TEST(FootAlongNormal, ScalesWithTheMesh) {
  const TriangleMesh small = sphere(0.05, 2);
  TriangleMesh large = small;
  constexpr double kScale = 1024.0;
  for (Vector3d& v : large.vertices_m) v *= kScale;
  const MeshSurface a(small), b(large);
  Random random(11);
  for (int trial = 0; trial < 200; ++trial) {
    const Vector3d p_m = 0.051 * Vector3d(random.normal(), random.normal(), random.normal()).normalized();
    const NormalFoot at = foot_along_normal(a, p_m, a.bvh.closest_point(p_m));
    const NormalFoot scaled = foot_along_normal(b, kScale * p_m, b.bvh.closest_point(kScale * p_m));
    EXPECT_EQ(at.triangle, scaled.triangle);
    EXPECT_EQ(at.p_m * kScale, scaled.p_m);
    EXPECT_EQ(at.height_m * kScale, scaled.height_m);
  }
}

// How far from the sphere the facets and their bulge together are at most, m, by 500 points; and the facets alone.
struct OffSphere {
  double bulged_m = 0.0, flat_m = 0.0;
};

OffSphere off_sphere(const MeshSurface& surface, double radius_m) {
  Random random(3);
  OffSphere out;
  for (int i = 0; i < 500; ++i) {
    const Vector3d p_m = 1.002 * radius_m * Vector3d(random.normal(), random.normal(), random.normal()).normalized();
    const NormalFoot foot = foot_along_normal(surface, p_m, surface.bvh.closest_point(p_m));
    EXPECT_TRUE(foot.on_normal);
    const double bulge_m = facet_bulge_m(surface, foot.triangle, foot.barycentric);
    out.flat_m = std::max(out.flat_m, radius_m - foot.p_m.norm());
    out.bulged_m = std::max(out.bulged_m, std::abs((foot.p_m + bulge_m * foot.normal).norm() - radius_m));
  }
  return out;
}

double longest_edge_m(const TriangleMesh& mesh) {
  double out = 0.0;
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t c = 0; c < 3; ++c)
      out = std::max(out, (mesh.vertices_m[t[(c + 1) % 3]] - mesh.vertices_m[t[c]]).norm());
  }
  return out;
}

// The facet and its bulge together are the sphere, inside the facets and over their edges.
TEST(FacetBulge, MakesASphereOfItsFacets) {
  constexpr double kRadius_m = 0.04;
  const MeshSurface surface(sphere(kRadius_m, 3));  // edges of 8 mm: a sag of up to 0.2 mm
  MeshSurface exact(sphere(kRadius_m, 3));
  double lean_rad = 0.0;
  for (std::size_t t = 0; t < exact.normals.size(); ++t) {
    for (std::size_t c = 0; c < 3; ++c) {
      const Vector3d radial = exact.mesh.vertices_m[exact.mesh.triangles[t][c]].normalized();
      lean_rad = std::max(lean_rad, (exact.normals[t][c] - radial).norm());
      exact.normals[t][c] = radial;
    }
  }
  // With the sphere's own normals what is left is of fourth order: a sag of c²/8R has c²/16R² of itself more, and a
  // facet's middle some times as much, c the edge.
  const double edge_m = longest_edge_m(surface.mesh), sag_m = edge_m * edge_m / (8.0 * kRadius_m);
  const OffSphere by_own = off_sphere(exact, kRadius_m);
  EXPECT_GT(by_own.flat_m, 0.15e-3);
  EXPECT_LT(by_own.bulged_m, 4.0 * sag_m * edge_m * edge_m / (16.0 * kRadius_m * kRadius_m));
  // The mesh's normals are means over some six facets of unlike shape, and lean by up to δ: each facet's own by c/√3R.
  // To ½ Σ w_a w_b d·(n_b − n_a), where Σ w_a w_b is at most 1/3, that adds at most δ c/3.
  EXPECT_LT(lean_rad, 0.25 * edge_m / (std::sqrt(3.0) * kRadius_m));
  EXPECT_LT(off_sphere(surface, kRadius_m).bulged_m, by_own.bulged_m + lean_rad * edge_m / 3.0);
}

TEST(FacetBulge, OfABoxIsNone) {
  const MeshSurface surface(box(Vector3d(1.0, 2.0, 3.0)));
  for (std::uint32_t t = 0; t < surface.mesh.triangles.size(); ++t)
    EXPECT_NEAR(facet_bulge_m(surface, t, Vector3d(0.2, 0.3, 0.5)), 0.0, 1e-15);
}

TEST(CornerNormals, OfASphereAreRadialAndOfABoxSquare) {
  const MeshSurface ball(sphere(1.0, 4));
  for (std::size_t t = 0; t < ball.mesh.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3d radial = ball.mesh.vertices_m[ball.mesh.triangles[t][k]].normalized();
      EXPECT_GT(ball.normals[t][k].dot(radial), std::cos(0.015));  // facets of 0.1 rad, uneven near the poles
    }
  }
  const MeshSurface cube(box({1, 1, 1}));
  for (std::size_t t = 0; t < cube.mesh.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(cube.normals[t][k].cwiseAbs().maxCoeff(), 1.0, 1e-15);
      EXPECT_NEAR(cube.normals[t][k].norm(), 1.0, 1e-15);
    }
  }
}

TEST(CornerNormals, AllFacetsJoinWhereTheCreaseAngleIsLarge) {
  const TriangleMesh mesh = box({1, 1, 1});
  const auto normals = corner_normals(mesh, make_adjacency(mesh), 3.0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3d diagonal = (mesh.vertices_m[mesh.triangles[t][k]] - Vector3d(0.5, 0.5, 0.5)).normalized();
      EXPECT_NEAR((normals[t][k] - diagonal).norm(), 0.0, 1e-12);
    }
  }
}

}  // namespace
}  // namespace asperity
