#include "texture_border.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "asperity/base/smoothstep.h"
#include "asperity/geometry/mesh_adjacency.h"
#include "asperity/texture/evaluate_height.h"

namespace asperity {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

constexpr double kSeamOfTheEdge = 1e-4;
constexpr double kSeamOfTheCoordinates = 1e-6;

// True if the heights of a texture step across an edge whose two ends have coordinates a_m in one triangle and b_m in
// the other: if they differ, at either end, by more than 10⁻⁴ of the edge's length in the texture and 10⁻⁶ of the
// coordinates (what files round away), and not by the same whole number of periods at both. Coordinates that the
// heights do not depend on do not count: none of them for a series, nor y for a model of x alone.
bool crosses_seam(const RenderTexture& texture, const std::array<Vector2d, 2>& a_m,
                  const std::array<Vector2d, 2>& b_m) {
  if (!is_height_field(texture.texture.model) || is_series(texture.model)) return false;
  const HeightPeriods periods = height_periods_m(texture.texture.model);
  const Vector2d period_m(periods.x_m, periods.y_m);
  const double edge_m = std::max((a_m[1] - a_m[0]).norm(), (b_m[1] - b_m[0]).norm());
  for (Eigen::Index axis = 0; axis < 2; ++axis) {
    if (period_m[axis] == 0.0) continue;
    const double first_m = b_m[0][axis] - a_m[0][axis];
    const double whole_m = std::isfinite(period_m[axis]) ? period_m[axis] * std::round(first_m / period_m[axis]) : 0.0;
    for (std::size_t end = 0; end < 2; ++end) {
      const double size_m = std::max(std::abs(a_m[end][axis]), std::abs(b_m[end][axis]));
      if (std::abs(b_m[end][axis] - a_m[end][axis] - whole_m) >
          kSeamOfTheEdge * edge_m + kSeamOfTheCoordinates * size_m)
        return true;
    }
  }
  return false;
}

}  // namespace

TextureBorder make_texture_border(const RenderObject& object, const std::vector<RenderTexture>& textures,
                                  double fade_m) {
  TextureBorder out;
  if (object.texture.empty() || !(fade_m > 0.0)) return out;
  const TriangleMesh welded = weld_vertices(object.mesh);
  const MeshAdjacency adjacency = make_adjacency(welded);
  const auto at_ends = [&](std::uint32_t t, const std::array<std::uint32_t, 2>& ends) {
    std::array<Eigen::Vector2d, 2> xy_m;
    for (std::size_t k = 0; k < 2; ++k) {
      const Triangle& corners = welded.triangles[t];
      const std::size_t corner = corners[0] == ends[k] ? 0 : corners[1] == ends[k] ? 1 : 2;
      xy_m[k] = object.texture_xy_m[t][corner];
    }
    return xy_m;
  };
  // The edges as triangles without area: distances to those are exact, and the tree finds the nearest at once.
  TriangleMesh edges;
  for (std::uint32_t e = 0; e < adjacency.edge_vertices.size(); ++e) {
    const auto triangles = adjacency.triangles_of_edge(e);
    const auto& ends = adjacency.edge_vertices[e];
    const std::int32_t texture = object.texture[triangles[0]];
    bool ends_here = false;
    for (const std::uint32_t t : triangles.subspan(1)) {
      ends_here = ends_here || object.texture[t] != texture ||
                  (texture >= 0 && crosses_seam(textures[static_cast<std::size_t>(texture)],
                                                at_ends(triangles[0], ends), at_ends(t, ends)));
    }
    if (!ends_here) continue;
    const auto first = static_cast<std::uint32_t>(edges.vertices_m.size());
    for (const std::uint32_t v : ends) edges.vertices_m.push_back(welded.vertices_m[v]);
    edges.triangles.push_back({first, first + 1, first + 1});
  }
  if (!edges.triangles.empty()) out.edges.emplace(edges);
  return out;
}

double border_fade(const RenderObject& object, const Vector3d& p_mesh_m, double fade_m) noexcept {
  if (!object.border.edges) return 1.0;
  const ClosestPoint nearest = object.border.edges->closest_point(p_mesh_m, fade_m);
  if (!nearest.found()) return 1.0;
  return smoothstep(nearest.distance_m / fade_m);
}

}  // namespace asperity
