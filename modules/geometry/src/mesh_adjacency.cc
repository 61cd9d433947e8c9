#include "asperity/geometry/mesh_adjacency.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <numeric>
#include <string>

#include "asperity/base/error.h"

namespace asperity {
namespace {

void check_indices(const TriangleMesh& mesh) {
  if (mesh.triangles.size() > std::numeric_limits<std::uint32_t>::max() / 3)
    throw Error("mesh: " + std::to_string(mesh.triangles.size()) + " triangles are more than indices of 32 bits");
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const std::uint32_t v : mesh.triangles[t]) {
      if (v >= mesh.vertices_m.size()) {
        throw Error("mesh: triangle " + std::to_string(t) + " names vertex " + std::to_string(v) + " of " +
                    std::to_string(mesh.vertices_m.size()));
      }
    }
  }
}

bool has_three_corners(const Triangle& tri) { return tri[0] != tri[1] && tri[1] != tri[2] && tri[2] != tri[0]; }

void list_triangles_of_vertices(const TriangleMesh& mesh, MeshAdjacency& out) {
  out.vertex_first.assign(mesh.vertices_m.size() + 1, 0);
  const auto each_corner = [&mesh](auto&& visit) {
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      if (!has_three_corners(mesh.triangles[t])) continue;
      for (const std::uint32_t v : mesh.triangles[t]) visit(v, t);
    }
  };
  each_corner([&out](std::uint32_t v, std::uint32_t) { ++out.vertex_first[v + 1]; });
  std::partial_sum(out.vertex_first.begin(), out.vertex_first.end(), out.vertex_first.begin());
  out.vertex_triangles.resize(out.vertex_first.back());
  std::vector<std::uint32_t> next(out.vertex_first.begin(), out.vertex_first.end() - 1);
  each_corner([&](std::uint32_t v, std::uint32_t t) { out.vertex_triangles[next[v]++] = t; });
}

struct HalfEdge {
  std::uint32_t low, high;  // its vertices
  std::uint32_t place;      // 3 triangle + e
};

// All half-edges by their lower vertex, then the higher one, then their place. A mesh's vertices have few each: counted
// into place by the lower one, only these few are compared.
std::vector<HalfEdge> sorted_half_edges(const TriangleMesh& mesh) {
  const auto each_edge = [&mesh](auto&& visit) {
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      if (!has_three_corners(mesh.triangles[t])) continue;
      for (std::uint32_t e = 0; e < 3; ++e) {
        const auto [low, high] = std::minmax(mesh.triangles[t][e], mesh.triangles[t][(e + 1) % 3]);
        visit(HalfEdge{low, high, 3 * t + e});
      }
    }
  };
  std::vector<std::size_t> first(mesh.vertices_m.size() + 1, 0);
  each_edge([&first](const HalfEdge& half) { ++first[half.low + 1]; });
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<HalfEdge> out(first.back());
  std::vector<std::size_t> next(first.begin(), first.end() - 1);
  each_edge([&](const HalfEdge& half) { out[next[half.low]++] = half; });
  for (std::size_t v = 0; v + 1 < first.size(); ++v) {
    std::sort(
        out.begin() + static_cast<std::ptrdiff_t>(first[v]), out.begin() + static_cast<std::ptrdiff_t>(first[v + 1]),
        [](const HalfEdge& a, const HalfEdge& b) { return a.high != b.high ? a.high < b.high : a.place < b.place; });
  }
  return out;
}

}  // namespace

MeshAdjacency make_adjacency(const TriangleMesh& mesh) {
  check_indices(mesh);
  MeshAdjacency out;
  list_triangles_of_vertices(mesh, out);

  const std::vector<HalfEdge> halves = sorted_half_edges(mesh);
  constexpr std::uint32_t kNone = MeshAdjacency::kNone;
  out.edge_of_triangle.assign(mesh.triangles.size(), {kNone, kNone, kNone});
  out.edge_triangles.reserve(halves.size());
  for (std::size_t i = 0; i < halves.size(); ++i) {
    const auto [low, high, place] = halves[i];
    const std::uint32_t triangle = place / 3;
    if (i == 0 || low != halves[i - 1].low || high != halves[i - 1].high) {
      out.edge_first.push_back(static_cast<std::uint32_t>(out.edge_triangles.size()));
      out.edge_vertices.push_back({low, high});
    }
    out.edge_triangles.push_back(triangle);
    out.edge_of_triangle[triangle][place % 3] = static_cast<std::uint32_t>(out.edge_vertices.size() - 1);
  }
  out.edge_first.push_back(static_cast<std::uint32_t>(out.edge_triangles.size()));
  return out;
}

TriangleMesh weld_vertices(const TriangleMesh& mesh) {
  check_indices(mesh);
  // By bits, so that nan has an order too; adding zero makes -0 the same as 0.
  const auto key = [&mesh](std::uint32_t v) {
    const Eigen::Vector3d& p = mesh.vertices_m[v];
    return std::array<std::uint64_t, 3>{std::bit_cast<std::uint64_t>(p.x() + 0.0),
                                        std::bit_cast<std::uint64_t>(p.y() + 0.0),
                                        std::bit_cast<std::uint64_t>(p.z() + 0.0)};
  };
  std::vector<std::uint32_t> order(mesh.vertices_m.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&key](std::uint32_t a, std::uint32_t b) {
    const auto ka = key(a);
    const auto kb = key(b);
    return ka != kb ? ka < kb : a < b;
  });
  std::vector<std::uint32_t> first(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    first[order[i]] = i > 0 && key(order[i]) == key(order[i - 1]) ? first[order[i - 1]] : order[i];
  }
  TriangleMesh out = mesh;
  for (Triangle& tri : out.triangles) {
    for (std::uint32_t& v : tri) v = first[v];
  }
  return out;
}

}  // namespace asperity
