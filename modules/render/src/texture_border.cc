#include "texture_border.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "asperity/geometry/mesh_adjacency.h"

namespace asperity {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kMostEdges = 64;  // of a triangle

double distance2_to_edge(const std::array<Vector3d, 2>& edge, const Vector3d& p_m) {
  const Vector3d along = edge[1] - edge[0], from = p_m - edge[0];
  const double square = along.squaredNorm();
  const double t = square > 0.0 ? std::clamp(from.dot(along) / square, 0.0, 1.0) : 0.0;
  return (from - t * along).squaredNorm();
}

}  // namespace

TextureBorder make_texture_border(const RenderObject& object, double fade_m) {
  TextureBorder out;
  if (object.texture.empty() || !(fade_m > 0.0)) return out;
  const TriangleMesh welded = weld_vertices(object.mesh);
  const MeshAdjacency adjacency = make_adjacency(welded);
  for (std::uint32_t e = 0; e < adjacency.edge_vertices.size(); ++e) {
    const auto triangles = adjacency.triangles_of_edge(e);
    bool differs = false;
    for (const std::uint32_t t : triangles) differs = differs || object.texture[t] != object.texture[triangles[0]];
    if (!differs) continue;
    out.edges_m.push_back(
        {welded.vertices_m[adjacency.edge_vertices[e][0]], welded.vertices_m[adjacency.edge_vertices[e][1]]});
  }
  if (out.edges_m.empty()) return out;

  // By triangle: the distance of an edge, no more than the true one, and the edge.
  std::vector<std::vector<std::pair<double, std::uint32_t>>> near(object.mesh.triangles.size());
  std::vector<std::uint32_t> found(1024);
  for (std::uint32_t e = 0; e < out.edges_m.size(); ++e) {
    const Vector3d middle_m = 0.5 * (out.edges_m[e][0] + out.edges_m[e][1]);
    const double half_m = 0.5 * (out.edges_m[e][1] - out.edges_m[e][0]).norm();
    std::size_t count = object.bvh.triangles_within(middle_m, half_m + fade_m, found);
    if (count > found.size()) {
      found.resize(count);
      count = object.bvh.triangles_within(middle_m, half_m + fade_m, found);
    }
    for (std::size_t k = 0; k < count; ++k) {
      const std::uint32_t t = found[k];
      if (object.texture[t] < 0) continue;
      const Triangle& corners = object.mesh.triangles[t];
      const Vector3d centre_m = (object.mesh.vertices_m[corners[0]] + object.mesh.vertices_m[corners[1]] +
                                 object.mesh.vertices_m[corners[2]]) /
                                3.0;
      double radius_m = 0.0;
      for (const std::uint32_t v : corners)
        radius_m = std::max(radius_m, (object.mesh.vertices_m[v] - centre_m).norm());
      const double distance_m = std::sqrt(distance2_to_edge(out.edges_m[e], centre_m)) - radius_m;
      if (distance_m > fade_m) continue;
      auto& list = near[t];
      list.emplace_back(distance_m, e);
      if (list.size() < 2 * kMostEdges) continue;
      std::sort(list.begin(), list.end());
      list.resize(kMostEdges);
    }
  }
  out.first.reserve(near.size() + 1);
  for (auto& list : near) {
    out.first.push_back(static_cast<std::uint32_t>(out.near.size()));
    std::sort(list.begin(), list.end());
    if (list.size() > kMostEdges) list.resize(kMostEdges);
    for (const auto& entry : list) out.near.push_back(entry.second);
  }
  out.first.push_back(static_cast<std::uint32_t>(out.near.size()));
  return out;
}

double border_fade(const RenderObject& object, std::uint32_t triangle, const Vector3d& p_mesh_m,
                   double fade_m) noexcept {
  const TextureBorder& border = object.border;
  if (border.first.empty()) return 1.0;
  double nearest2 = fade_m * fade_m;
  for (std::uint32_t k = border.first[triangle]; k < border.first[triangle + 1]; ++k)
    nearest2 = std::min(nearest2, distance2_to_edge(border.edges_m[border.near[k]], p_mesh_m));
  const double t = std::min(std::sqrt(nearest2) / fade_m, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

}  // namespace asperity
