#include "asperity/geometry/geodesic_path.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "asperity/base/error.h"
#include "asperity/base/random.h"
#include "asperity/testkit/shape_meshes.h"

namespace asperity {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;

MeshPoint random_point(const TriangleMesh& mesh, Random& random) {
  double a = random.uniform();
  double b = random.uniform();
  if (a + b > 1.0) {
    a = 1.0 - a;
    b = 1.0 - b;
  }
  const auto triangle = static_cast<std::uint32_t>(random.uniform(0.0, static_cast<double>(mesh.triangles.size())));
  return {triangle, {a, b, 1.0 - a - b}};
}

// The point of the mesh that is nearest to p, by brute force over a grid of no more than the corners' hull.
MeshPoint nearest(const TriangleMesh& mesh, const Vector3d& p) {
  MeshPoint best;
  double best_m = std::numeric_limits<double>::infinity();
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [ia, ib, ic] = mesh.triangles[t];
    const Vector3d a = mesh.vertices_m[ia];
    Eigen::Matrix<double, 3, 2> m;
    m << mesh.vertices_m[ib] - a, mesh.vertices_m[ic] - a;
    const Eigen::Vector2d x = (m.transpose() * m).inverse() * (m.transpose() * (p - a));
    Vector3d w(1.0 - x.sum(), x[0], x[1]);
    w = w.cwiseMax(0.0);
    w /= w.sum();
    const double d = (position_m(mesh, {t, w}) - p).norm();
    if (d < best_m) {
      best_m = d;
      best = {t, w};
    }
  }
  return best;
}

void expect_well_formed(const TriangleMesh& mesh, const MeshPath& path) {
  ASSERT_EQ(path.triangle.size(), path.size());
  ASSERT_EQ(path.s_m.size(), path.size());
  ASSERT_GE(path.size(), 2u);
  double sum = 0.0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (i > 0) sum += (path.p_mesh_m[i] - path.p_mesh_m[i - 1]).norm();
    EXPECT_NEAR(path.s_m[i], sum, 1e-12);
    for (const std::size_t k : {i, i + 1}) {  // both ends of the piece lie in its triangle
      if (k == path.size()) continue;
      const auto& [a, b, c] = mesh.triangles[path.triangle[i]];
      const Vector3d n = (mesh.vertices_m[b] - mesh.vertices_m[a]).cross(mesh.vertices_m[c] - mesh.vertices_m[a]);
      EXPECT_NEAR(n.normalized().dot(path.p_mesh_m[k] - mesh.vertices_m[a]), 0.0, 1e-12);
      for (const auto& [u, v] : {std::pair{a, b}, std::pair{b, c}, std::pair{c, a}}) {
        EXPECT_GT(
            n.cross(mesh.vertices_m[v] - mesh.vertices_m[u]).normalized().dot(path.p_mesh_m[k] - mesh.vertices_m[u]),
            -1e-12);
      }
    }
  }
}

TEST(GeodesicPath, IsStraightInThePlaneWhateverTheTriangles) {
  const TriangleMesh mesh = testkit::plane_mesh({0.1, 0.08}, 25, 20, 0.24, 3);
  const MeshAdjacency adjacency = make_adjacency(mesh);
  Random random(7);
  for (int i = 0; i < 100; ++i) {
    const MeshPoint a = random_point(mesh, random);
    const MeshPoint b = random_point(mesh, random);
    const GeodesicPath g = geodesic_path(mesh, adjacency, a, b);
    EXPECT_TRUE(g.locally_shortest);
    EXPECT_NEAR(g.path.s_m.back(), (position_m(mesh, a) - position_m(mesh, b)).norm(), 1e-14);
    expect_well_formed(mesh, g.path);
  }
}

TEST(GeodesicPath, RunsAlongTheLinesOfAGridThroughItsVertices) {
  const TriangleMesh mesh = testkit::plane_mesh({0.1, 0.1}, 10, 10);
  const MeshAdjacency adjacency = make_adjacency(mesh);
  Random random(3);
  for (int i = 0; i < 200; ++i) {  // from vertex to vertex: every collinear case
    const auto corner = [&] {
      MeshPoint p = random_point(mesh, random);
      p.barycentric = Vector3d::Unit(static_cast<int>(random.uniform(0.0, 3.0)));
      return p;
    };
    const MeshPoint a = corner();
    const MeshPoint b = corner();
    const GeodesicPath g = geodesic_path(mesh, adjacency, a, b);
    EXPECT_NEAR(g.path.s_m.back(), (position_m(mesh, a) - position_m(mesh, b)).norm(), 1e-14);
    expect_well_formed(mesh, g.path);
  }
}

TEST(GeodesicPath, DoesNotTurnBackWhereItRunsAlongAnEdge) {
  const TriangleMesh mesh = testkit::box_mesh({0.03, 0.02, 0.005}, 10);
  const MeshAdjacency adjacency = make_adjacency(mesh);
  Random random(6);
  for (int i = 0; i < 200; ++i) {  // within rounding of a line of edges, from any triangle that touches it
    const double y = 0.01 + 1e-17 * std::floor(random.uniform(-2.0, 3.0));
    const Vector3d from(random.uniform(0.001, 0.029), y, 0.005);
    const Vector3d to(random.uniform(0.001, 0.029), 0.01, 0.005);
    const GeodesicPath g = geodesic_path(mesh, adjacency, nearest(mesh, from), nearest(mesh, to));
    EXPECT_NEAR(g.path.s_m.back(), (from - to).norm(), 1e-12);
  }
}

TEST(GeodesicPath, CrossesABoxAsItsUnfoldingSays) {
  const TriangleMesh mesh = testkit::box_mesh({0.06, 0.05, 0.04}, 6);
  const MeshAdjacency adjacency = make_adjacency(mesh);
  // From the top (z = 0.04) over the edge x = 0.06 to the side: the side turned up into the top's plane.
  const MeshPoint top = nearest(mesh, {0.031, 0.013, 0.04});
  const MeshPoint side = nearest(mesh, {0.06, 0.037, 0.017});
  const GeodesicPath g = geodesic_path(mesh, adjacency, top, side);
  EXPECT_NEAR(g.path.s_m.back(), std::hypot(0.029 + 0.023, 0.024), 1e-12);
  expect_well_formed(mesh, g.path);
}

TEST(GeodesicPath, HasTheLengthOfAHelixOnAPrism) {
  constexpr int kAround = 48;
  const double radius_m = 0.03;
  const TriangleMesh mesh = testkit::cylinder_mesh(radius_m, 0.1, kAround, 40, 2.0 * pi, 9);
  const MeshAdjacency adjacency = make_adjacency(mesh);
  // The prism unrolls exactly: facet widths instead of arcs.
  const double facet_m = 2.0 * radius_m * std::sin(pi / kAround);
  const auto on_prism = [&](double facets, double z_m) {
    const auto k = std::floor(facets);
    const auto at = [&](double n) {
      return Vector3d(radius_m * std::cos(2.0 * pi * n / kAround), radius_m * std::sin(2.0 * pi * n / kAround), z_m);
    };
    return Vector3d(at(k) + (facets - k) * (at(k + 1.0) - at(k)));
  };
  const GeodesicPath g =
      geodesic_path(mesh, adjacency, nearest(mesh, on_prism(1.3, 0.011)), nearest(mesh, on_prism(19.6, 0.083)));
  EXPECT_NEAR(g.path.s_m.back(), std::hypot(18.3 * facet_m, 0.072), 1e-12);
  expect_well_formed(mesh, g.path);
}

TEST(GeodesicPath, ApproachesTheGreatCircleWithSecondOrder) {
  double last_error = 0.0;
  for (const int levels : {3, 4, 5}) {
    const TriangleMesh mesh = testkit::sphere_mesh(1.0, levels);
    const MeshAdjacency adjacency = make_adjacency(mesh);
    Random random(11);
    double error = 0.0;
    for (int i = 0; i < 20; ++i) {
      const MeshPoint a = random_point(mesh, random);
      const MeshPoint b = random_point(mesh, random);
      const Vector3d pa = position_m(mesh, a).normalized();
      const Vector3d pb = position_m(mesh, b).normalized();
      const double truth = std::atan2(pa.cross(pb).norm(), pa.dot(pb));
      const GeodesicPath g = geodesic_path(mesh, adjacency, a, b);
      EXPECT_TRUE(g.locally_shortest);
      expect_well_formed(mesh, g.path);
      error = std::max(error, std::abs(g.path.s_m.back() / truth - 1.0));
    }
    // A chord of edge h deviates from the arc by h²/8 at most, the length by a relative h²/8 or less twice.
    const double h = 1.1 * std::pow(0.5, levels);
    EXPECT_LT(error, 0.5 * h * h);
    if (last_error > 0.0) {
      EXPECT_LT(error, 0.5 * last_error);
    }
    last_error = error;
  }
}

TEST(GeodesicPath, BendsRoundTheCornersOfAHoleOnly) {
  // A square plate without its middle: the path between the middles of opposite sides bends at two corners.
  TriangleMesh mesh = testkit::plane_mesh({0.03, 0.03}, 30, 30);
  std::erase_if(mesh.triangles, [&mesh](const Triangle& tri) {
    const Vector3d c = (mesh.vertices_m[tri[0]] + mesh.vertices_m[tri[1]] + mesh.vertices_m[tri[2]]) / 3.0;
    return c.x() > 0.01 && c.x() < 0.02 && c.y() > 0.01 && c.y() < 0.0201;
  });
  const MeshAdjacency adjacency = make_adjacency(mesh);
  const GeodesicPath g =
      geodesic_path(mesh, adjacency, nearest(mesh, {0.0005, 0.0143, 0.0}), nearest(mesh, {0.0295, 0.0143, 0.0}));
  EXPECT_NEAR(g.path.s_m.back(), 0.01 + 2.0 * std::hypot(0.0095, 0.0043), 1e-12);
  expect_well_formed(mesh, g.path);
}

TEST(GeodesicPath, GoesOverEdgesThatManyTrianglesShare) {
  // Three quarter planes on one edge, as an open book with a page upright.
  const TriangleMesh mesh{{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, 1, 0}, {0, 0, 1}, {0, 1, 1}},
                          {{0, 2, 3}, {0, 3, 1}, {0, 1, 5}, {0, 5, 4}, {0, 1, 7}, {0, 7, 6}}};
  const MeshAdjacency adjacency = make_adjacency(mesh);
  const GeodesicPath flat =
      geodesic_path(mesh, adjacency, nearest(mesh, {0.7, 0.2, 0.0}), nearest(mesh, {-0.5, 0.9, 0.0}));
  EXPECT_NEAR(flat.path.s_m.back(), std::hypot(1.2, 0.7), 1e-14);
  const GeodesicPath up =
      geodesic_path(mesh, adjacency, nearest(mesh, {0.7, 0.2, 0.0}), nearest(mesh, {0.0, 0.9, 0.4}));
  EXPECT_NEAR(up.path.s_m.back(), std::hypot(1.1, 0.7), 1e-14);
}

TEST(GeodesicPath, JoinsPicks) {
  const TriangleMesh mesh = testkit::plane_mesh({0.1, 0.1}, 20, 20, 0.24);
  const MeshAdjacency adjacency = make_adjacency(mesh);
  const std::vector<MeshPoint> picks{nearest(mesh, {0.01, 0.02, 0}), nearest(mesh, {0.06, 0.03, 0}),
                                     nearest(mesh, {0.06, 0.03, 0}), nearest(mesh, {0.09, 0.08, 0})};
  const GeodesicPath g = geodesic_path(mesh, adjacency, picks);
  EXPECT_NEAR(g.path.s_m.back(), std::hypot(0.05, 0.01) + std::hypot(0.03, 0.05), 1e-12);
  EXPECT_THROW(geodesic_path(mesh, adjacency, std::span(picks).first(1)), Error);
}

TEST(GeodesicPath, NoConnectionAndForeignPointsAreErrors) {
  TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 0, 0}, {6, 0, 0}, {5, 1, 0}}, {{0, 1, 2}, {3, 4, 5}}};
  const MeshAdjacency adjacency = make_adjacency(mesh);
  EXPECT_THROW(geodesic_path(mesh, adjacency, MeshPoint{0, {1, 0, 0}}, MeshPoint{1, {1, 0, 0}}), Error);
  EXPECT_THROW(geodesic_path(mesh, adjacency, MeshPoint{2, {1, 0, 0}}, MeshPoint{1, {1, 0, 0}}), Error);
  EXPECT_THROW(geodesic_path(mesh, adjacency, MeshPoint{0, {2, -1, 0}}, MeshPoint{0, {1, 0, 0}}), Error);
}

TEST(GeodesicPath, PowersOfTwoScaleIt) {
  const TriangleMesh mesh = testkit::sphere_mesh(1.0, 3);
  TriangleMesh scaled = mesh;
  for (Vector3d& p : scaled.vertices_m) p *= 0x1p-30;
  const MeshAdjacency adjacency = make_adjacency(mesh);
  const MeshPoint a{17, {0.2, 0.3, 0.5}};
  const MeshPoint b{901, {0.6, 0.3, 0.1}};
  EXPECT_EQ(geodesic_path(mesh, adjacency, a, b).path.s_m.back() * 0x1p-30,
            geodesic_path(scaled, adjacency, a, b).path.s_m.back());
}

}  // namespace
}  // namespace asperity
