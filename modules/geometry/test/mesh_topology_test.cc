#include <cmath>
#include <numbers>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "asperity/base/error.h"
#include "asperity/base/random.h"
#include "asperity/geometry/corner_normals.h"
#include "asperity/geometry/mesh_adjacency.h"
#include "asperity/geometry/mesh_normals.h"
#include "asperity/geometry/mesh_surface.h"

namespace asperity {
namespace {

using Eigen::Vector3d;
using testing::ElementsAre;

TriangleMesh cube() {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) mesh.vertices_m.push_back({double(i & 1), double(i >> 1 & 1), double(i >> 2 & 1)});
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

TEST(MeshAdjacency, ClosedSurfaceHasTwoTrianglesAnEdgeAndEulersCount) {
  const TriangleMesh mesh = cube();
  const MeshAdjacency a = make_adjacency(mesh);
  EXPECT_EQ(a.edge_vertices.size(), 18u);  // V - E + F = 2
  for (std::uint32_t e = 0; e < 18; ++e) EXPECT_EQ(a.triangles_of_edge(e).size(), 2u);
}

TEST(MeshAdjacency, AgreesWithBruteForceOnRandomSoup) {
  Random random(5);
  TriangleMesh mesh;
  mesh.vertices_m.assign(12, Vector3d::Zero());
  for (int i = 0; i < 40; ++i) {
    Triangle tri;
    for (std::uint32_t& v : tri) v = static_cast<std::uint32_t>(random.uniform(0.0, 12.0));
    mesh.triangles.push_back(tri);
  }
  const MeshAdjacency a = make_adjacency(mesh);
  const auto whole = [&mesh](std::uint32_t t) {
    return std::set<std::uint32_t>(mesh.triangles[t].begin(), mesh.triangles[t].end()).size() == 3;
  };
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t e = 0; e < 3; ++e) {
      if (!whole(t)) {
        EXPECT_EQ(a.edge_of_triangle[t][e], MeshAdjacency::kNone);
        continue;
      }
      const std::set<std::uint32_t> ends{mesh.triangles[t][e], mesh.triangles[t][(e + 1) % 3]};
      std::vector<std::uint32_t> expected;
      for (std::uint32_t u = 0; u < mesh.triangles.size(); ++u) {
        bool has = false;
        for (std::size_t f = 0; f < 3; ++f) {
          has |= ends == std::set<std::uint32_t>{mesh.triangles[u][f], mesh.triangles[u][(f + 1) % 3]};
        }
        if (has && whole(u)) expected.push_back(u);
      }
      EXPECT_THAT(a.triangles_of_edge(a.edge_of_triangle[t][e]), testing::ElementsAreArray(expected));
    }
  }
  for (std::uint32_t v = 0; v < 12; ++v) {
    std::vector<std::uint32_t> expected;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      if (std::count(mesh.triangles[t].begin(), mesh.triangles[t].end(), v) > 0 && whole(t)) expected.push_back(t);
    }
    EXPECT_THAT(a.triangles_of_vertex(v), testing::ElementsAreArray(expected));
  }
}

TEST(MeshAdjacency, IndexOutOfRangeIsAnError) {
  TriangleMesh mesh = cube();
  mesh.triangles[3][1] = 8;
  EXPECT_THROW(make_adjacency(mesh), Error);
  EXPECT_THROW(weld_vertices(mesh), Error);
}

TEST(WeldVertices, SoupBecomesOneSurface) {
  const TriangleMesh whole = cube();
  TriangleMesh soup;
  for (const Triangle& tri : whole.triangles) {
    const auto first = static_cast<std::uint32_t>(soup.vertices_m.size());
    for (const std::uint32_t v : tri) soup.vertices_m.push_back(whole.vertices_m[v]);
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  soup.vertices_m[0].x() = -0.0;
  EXPECT_EQ(make_adjacency(soup).edge_vertices.size(), 36u);
  EXPECT_EQ(make_adjacency(weld_vertices(soup)).edge_vertices.size(), 18u);
}

TEST(MeshNormals, CubesCornersPointAlongItsDiagonalsHoweverItIsTriangulated) {
  const TriangleMesh mesh = cube();
  const auto facets = facet_normals(mesh);
  EXPECT_EQ(facets[0], Vector3d(0, 0, -1));
  EXPECT_EQ(facets[11], Vector3d(1, 0, 0));
  const auto normals = vertex_normals(mesh);
  for (std::size_t v = 0; v < 8; ++v) {
    const Vector3d diagonal = (mesh.vertices_m[v] - Vector3d::Constant(0.5)).normalized();
    EXPECT_LT((normals[v] - diagonal).norm(), 1e-14);
  }
}

TEST(MeshNormals, DegenerateTrianglesContributeNothing) {
  TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.1, 0.3, 0}, {0.3, 0.9, 0}},
                    {{0, 1, 2}, {0, 1, 1}, {0, 3, 4}, {0, 0, 0}}};
  EXPECT_TRUE(facet_normals(mesh)[1].isZero(0.0));
  EXPECT_TRUE(facet_normals(mesh)[2].isZero(0.0));
  EXPECT_EQ(vertex_normals(mesh)[0], Vector3d(0, 0, 1));
  EXPECT_TRUE(vertex_normals(mesh)[4].isZero(0.0));
}

TEST(MeshNormals, PowersOfTwoChangeNothing) {
  for (const double scale : {0x1p-300, 0x1p-40, 0x1p200}) {
    TriangleMesh mesh = cube();
    mesh.vertices_m[3] += Vector3d(0.1, 0.7, 0.3);
    TriangleMesh scaled = mesh;
    for (Vector3d& p : scaled.vertices_m) p *= scale;
    EXPECT_EQ(vertex_normals(mesh), vertex_normals(scaled));
    EXPECT_EQ(facet_normals(mesh), facet_normals(scaled));
  }
}

TEST(MeshNormals, InterpolatedFallsBackToTheFacet) {
  const TriangleMesh mesh = cube();
  const auto normals = vertex_normals(mesh);
  const Vector3d middle = interpolated_normal(mesh, normals, 0, {0.0, 0.5, 0.5});
  EXPECT_LT((middle - Vector3d(0, 0, -1)).norm(), 1e-14);
  const std::vector<Vector3d> none(8, Vector3d::Zero());
  EXPECT_EQ(interpolated_normal(mesh, none, 0, {0.2, 0.3, 0.5}), Vector3d(0, 0, -1));
}

// A hub of many triangles: what is done about a vertex must not grow with their square.
TEST(CornerNormals, AFanOfManyTrianglesIsOneSurface) {
  constexpr std::uint32_t kRim = 300'000;
  TriangleMesh mesh;
  mesh.vertices_m.emplace_back(0.0, 0.0, 0.0);
  for (std::uint32_t i = 0; i < kRim; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kRim;
    mesh.vertices_m.emplace_back(std::cos(angle), std::sin(angle), 0.0);
    mesh.triangles.push_back({0, 1 + i, 1 + (i + 1) % kRim});
  }
  const auto normals = corner_normals(mesh, make_adjacency(mesh));
  for (const auto& corners : normals) {
    for (const Vector3d& normal : corners) ASSERT_LT((normal - Vector3d::UnitZ()).norm(), 1e-12);
  }
}

TEST(MeshSurface, NothingLiesAcrossATriangleThatNamesAVertexTwice) {
  const TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 1, 1}}};
  const MeshAdjacency adjacency = make_adjacency(mesh);
  for (std::size_t e = 0; e < 3; ++e) EXPECT_EQ(triangle_across(adjacency, 1, e), ClosestPoint::kNone);
}

}  // namespace
}  // namespace asperity
