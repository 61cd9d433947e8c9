#include "asperity/geometry/surface_patch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <string>

#include <Eigen/Geometry>

#include "asperity/base/error.h"
#include "asperity/geometry/nearest_on_triangle.h"

namespace asperity {
namespace {

constexpr std::uint32_t kNobody = std::numeric_limits<std::uint32_t>::max();

double triangle_area_m2(const TriangleMesh& mesh, std::uint32_t t) {
  const Triangle& v = mesh.triangles[t];
  return 0.5 *
         (mesh.vertices_m[v[1]] - mesh.vertices_m[v[0]]).cross(mesh.vertices_m[v[2]] - mesh.vertices_m[v[0]]).norm();
}

struct PatchSearch {};  // names the instruction set of nearest_on_triangle: this file's

double distance_to_triangle_m(const TriangleMesh& mesh, std::uint32_t t, const Eigen::Vector3d& p) {
  std::array<const double*, 3> corner{};
  for (std::size_t c = 0; c < 3; ++c) corner[c] = mesh.vertices_m[mesh.triangles[t][c]].data();
  std::sort(corner.begin(), corner.end(),
            [](const double* a, const double* b) { return std::lexicographical_compare(a, a + 3, b, b + 3); });
  return std::sqrt(bvh::nearest_on_triangle<PatchSearch>(corner[0], corner[1], corner[2], p.data()).distance2);
}

// Pieces of those triangles whose flag is `wanted`, joined by edges: the piece of each, kNobody for the others.
std::vector<std::uint32_t> pieces_of(const MeshSurface& surface, const std::vector<char>& flag, char wanted,
                                     std::uint32_t& count) {
  std::vector<std::uint32_t> piece(flag.size(), kNobody), stack;
  count = 0;
  for (std::uint32_t seed = 0; seed < flag.size(); ++seed) {
    if (flag[seed] != wanted || piece[seed] != kNobody) continue;
    piece[seed] = count;
    stack.push_back(seed);
    while (!stack.empty()) {
      const std::uint32_t t = stack.back();
      stack.pop_back();
      for (std::size_t e = 0; e < 3; ++e) {
        const std::uint32_t other = triangle_across(surface.adjacency, t, e);
        if (other == ClosestPoint::kNone || flag[other] != wanted || piece[other] != kNobody) continue;
        piece[other] = count;
        stack.push_back(other);
      }
    }
    ++count;
  }
  return piece;
}

// The triangles within `reach_m` of a path's points, by way of neighbours that are: flags.
std::vector<char> reached(const MeshSurface& surface, std::span<const MeshPath> paths, double reach_m) {
  std::vector<char> in(surface.mesh.triangles.size(), 0);
  std::vector<std::uint32_t> seen(in.size(), kNobody), stack;
  std::uint32_t number = 0;
  for (const MeshPath& path : paths) {
    const Eigen::Vector3d* last = nullptr;
    for (std::size_t i = 0; i < path.size(); ++i) {
      const Eigen::Vector3d& p = path.p_mesh_m[i];
      in[path.triangle[i]] = 1;
      // Points much nearer to each other than the reach add little but work.
      if (last != nullptr && i + 1 < path.size() && (p - *last).norm() < 0.1 * reach_m) continue;
      last = &p;
      stack.push_back(path.triangle[i]);
      seen[path.triangle[i]] = number;
      while (!stack.empty()) {
        const std::uint32_t t = stack.back();
        stack.pop_back();
        for (std::size_t e = 0; e < 3; ++e) {
          const std::uint32_t other = triangle_across(surface.adjacency, t, e);
          if (other == ClosestPoint::kNone || seen[other] == number) continue;
          seen[other] = number;
          if (distance_to_triangle_m(surface.mesh, other, p) > reach_m) continue;
          in[other] = 1;
          stack.push_back(other);
        }
      }
      ++number;
    }
  }
  return in;
}

// Keeps the piece with most of the points.
void keep_largest(const MeshSurface& surface, std::span<const MeshPath> paths, std::vector<char>& in,
                  SurfacePatch& out) {
  std::uint32_t count = 0;
  const std::vector<std::uint32_t> piece = pieces_of(surface, in, 1, count);
  std::vector<std::size_t> points(count, 0);
  for (const MeshPath& path : paths)
    for (const std::uint32_t t : path.triangle) ++points[piece[t]];
  if (points.empty()) throw Error("area: no stroke is on the mesh");
  const auto largest = static_cast<std::uint32_t>(std::max_element(points.begin(), points.end()) - points.begin());
  for (std::size_t t = 0; t < in.size(); ++t) in[t] = piece[t] == largest ? 1 : 0;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const bool touches =
        std::any_of(paths[i].triangle.begin(), paths[i].triangle.end(), [&](std::uint32_t t) { return in[t] != 0; });
    if (!touches) out.paths_apart.push_back(i);
  }
}

// Fills the gaps that the patch encloses: all pieces of the rest but the largest, unless they reach the mesh's border.
std::size_t fill_gaps(const MeshSurface& surface, std::vector<char>& in) {
  std::uint32_t count = 0;
  const std::vector<std::uint32_t> piece = pieces_of(surface, in, 0, count);
  std::vector<double> area_m2(count, 0.0);
  std::vector<char> keep(count, 0);
  double own_m2 = 0.0;
  for (std::uint32_t t = 0; t < in.size(); ++t) {
    if (in[t] != 0) {
      own_m2 += triangle_area_m2(surface.mesh, t);
      continue;
    }
    area_m2[piece[t]] += triangle_area_m2(surface.mesh, t);
    for (std::size_t e = 0; e < 3; ++e)
      if (triangle_across(surface.adjacency, t, e) == ClosestPoint::kNone) keep[piece[t]] = 1;
  }
  if (count == 0) return 0;
  // On an open mesh the pieces with a border are the rest; on a closed one the largest is.
  if (std::find(keep.begin(), keep.end(), char{1}) == keep.end())
    keep[static_cast<std::size_t>(std::max_element(area_m2.begin(), area_m2.end()) - area_m2.begin())] = 1;
  // Another part of the mesh, which no path touches, is no gap.
  std::vector<char> meets(count, 0);
  for (std::uint32_t t = 0; t < in.size(); ++t) {
    if (in[t] != 0) continue;
    for (std::size_t e = 0; e < 3; ++e) {
      const std::uint32_t other = triangle_across(surface.adjacency, t, e);
      if (other != ClosestPoint::kNone && in[other] != 0) meets[piece[t]] = 1;
    }
  }
  double gap_m2 = 0.0;
  for (std::uint32_t p = 0; p < count; ++p) gap_m2 += keep[p] == 0 && meets[p] != 0 ? area_m2[p] : 0.0;
  if (gap_m2 > own_m2) return 0;
  std::size_t filled = 0;
  for (std::size_t t = 0; t < in.size(); ++t) {
    if (in[t] != 0 || keep[piece[t]] != 0 || meets[piece[t]] == 0) continue;
    in[t] = 1;
    ++filled;
  }
  return filled;
}

// A vertex at which the patch meets itself has more than one run of its triangles; all triangles about it are added.
bool close_pinches(const MeshSurface& surface, std::vector<char>& in) {
  const TriangleMesh& mesh = surface.mesh;
  std::vector<std::uint32_t> pinched;
  for (std::uint32_t v = 0; v < mesh.vertices_m.size(); ++v) {
    const auto round = surface.adjacency.triangles_of_vertex(v);
    int borders = 0;
    for (const std::uint32_t t : round) {
      if (in[t] == 0) continue;
      for (std::size_t e = 0; e < 3; ++e) {
        if (mesh.triangles[t][e] != v && mesh.triangles[t][(e + 1) % 3] != v) continue;
        const std::uint32_t other = triangle_across(surface.adjacency, t, e);
        if (other == ClosestPoint::kNone || in[other] == 0) ++borders;
      }
    }
    if (borders > 2) pinched.push_back(v);
  }
  for (const std::uint32_t v : pinched)
    for (const std::uint32_t t : surface.adjacency.triangles_of_vertex(v)) in[t] = 1;
  return !pinched.empty();
}

// The border of the patch as one loop; empty if it is none or several.
std::vector<std::uint32_t> border_loop(const TriangleMesh& patch) {
  std::map<std::array<std::uint32_t, 2>, int> directed;
  for (const Triangle& t : patch.triangles)
    for (std::size_t e = 0; e < 3; ++e) ++directed[{t[e], t[(e + 1) % 3]}];
  std::map<std::uint32_t, std::uint32_t> next;
  std::size_t edges = 0;
  for (const auto& [edge, count] : directed) {
    if (count > 1) throw Error("area: the mesh is not oriented alike on both sides of an edge of the strokes' patch");
    if (directed.contains({edge[1], edge[0]})) continue;
    next[edge[0]] = edge[1];
    ++edges;
  }
  if (edges == 0 || next.size() != edges) return {};
  std::vector<std::uint32_t> loop{next.begin()->first};
  while (loop.size() <= edges) {
    const auto found = next.find(loop.back());
    if (found == next.end()) return {};
    if (found->second == loop.front()) break;
    loop.push_back(found->second);
  }
  if (loop.size() != edges) return {};
  return loop;
}

void number_patch(const TriangleMesh& mesh, const std::vector<char>& in, SurfacePatch& out) {
  std::vector<std::uint32_t> own(mesh.vertices_m.size(), kNobody);
  for (std::uint32_t t = 0; t < in.size(); ++t) {
    if (in[t] == 0) continue;
    Triangle tri{};
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t v = mesh.triangles[t][c];
      if (own[v] == kNobody) {
        own[v] = static_cast<std::uint32_t>(out.vertex.size());
        out.vertex.push_back(v);
        out.mesh.vertices_m.push_back(mesh.vertices_m[v]);
      }
      tri[c] = own[v];
    }
    out.mesh.triangles.push_back(tri);
    out.triangle.push_back(t);
  }
}

}  // namespace

SurfacePatch find_surface_patch(const MeshSurface& surface, std::span<const MeshPath> paths,
                                const SurfacePatchConfig& config) {
  SurfacePatch out;
  std::vector<char> in = reached(surface, paths, 1e-3 * config.reach_mm);
  keep_largest(surface, paths, in, out);
  constexpr int kMostRounds = 64;
  for (int round = 0; round < kMostRounds; ++round) {
    out.filled += fill_gaps(surface, in);
    if (!close_pinches(surface, in)) break;
  }
  number_patch(surface.mesh, in, out);
  out.border = border_loop(out.mesh);
  // Euler's number of a disc is 1.
  std::size_t half_edges = 3 * out.mesh.triangles.size() + out.border.size();
  const bool is_disc = !out.border.empty() && half_edges % 2 == 0 &&
                       out.mesh.vertices_m.size() + out.mesh.triangles.size() == half_edges / 2 + 1;
  if (!is_disc) {
    throw Error(
        "area: the " + std::to_string(out.mesh.triangles.size()) +
        " triangles about the strokes are not a disc: they enclose the object or a hole of the mesh, or cover all "
        "of it; use the strokes of one side, or a smaller patch.reach_mm");
  }
  return out;
}

}  // namespace asperity
