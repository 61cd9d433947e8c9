#include "asperity/geometry/geodesic_path.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>

#include <Eigen/Geometry>

#include "asperity/base/error.h"
#include "strip_funnel.h"

namespace asperity {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// A detour is taken only if it is shorter by more than rounding, or two equal ways would alternate.
constexpr double kAngleTol_rad = 1e-9;

void check_mesh_point(const TriangleMesh& mesh, const MeshAdjacency& adjacency, const MeshPoint& point) {
  if (adjacency.edge_of_triangle.size() != mesh.triangles.size())
    throw Error("geodesic path: the adjacency is of another mesh");
  if (point.triangle >= mesh.triangles.size()) {
    throw Error("geodesic path: triangle " + std::to_string(point.triangle) + " of " +
                std::to_string(mesh.triangles.size()));
  }
  constexpr double kSlack = 1e-9;  // weights from a closest-point query are rounded
  const Vector3d& w = point.barycentric;
  if (!w.allFinite() || w.minCoeff() < -kSlack || std::abs(w.sum() - 1.0) > kSlack ||
      !position_m(mesh, point).allFinite())
    throw Error("geodesic path: a point is not on triangle " + std::to_string(point.triangle));
}

double angle_between(const Vector2d& a, const Vector2d& b) {
  return std::atan2(std::abs(a.x() * b.y() - a.y() * b.x()), a.dot(b));
}

double corner_angle(const TriangleMesh& mesh, std::uint32_t triangle, std::uint32_t vertex) {
  const Triangle& tri = mesh.triangles[triangle];
  const std::size_t i = tri[0] == vertex ? 0 : tri[1] == vertex ? 1 : 2;
  const Vector3d a = mesh.vertices_m[tri[(i + 1) % 3]] - mesh.vertices_m[vertex];
  const Vector3d b = mesh.vertices_m[tri[(i + 2) % 3]] - mesh.vertices_m[vertex];
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

// The triangles round `vertex` between the first and last of a strip's that touch it, on the other side.
struct OtherSide {
  double angle_rad = 0.0;
  std::size_t first_face = 0;  // in the strip
  std::size_t last_face = 0;
  TriangleStrip around;  // from first_face to last_face, both included
};

std::optional<OtherSide> other_side(const TriangleMesh& mesh, const MeshAdjacency& adjacency,
                                    const TriangleStrip& strip, const UnfoldedStrip& flat, const Bend& bend,
                                    const Vector2d& before, const Vector2d& after) {
  const auto vertex_of = [&](std::size_t i) {
    return bend.left ? flat.portals[i].left_vertex : flat.portals[i].right_vertex;
  };
  const auto opposite = [&](std::size_t i) { return bend.left ? flat.portals[i].right : flat.portals[i].left; };
  const std::uint32_t vertex = vertex_of(bend.portal);
  const Vector2d place = bend.left ? flat.portals[bend.portal].left : flat.portals[bend.portal].right;
  std::size_t first = bend.portal, last = first;
  // Where the path comes or goes along an edge of the strip, it touches the vertex from there on only.
  while (first > 0 && vertex_of(first - 1) == vertex && opposite(first) != before) --first;
  while (last + 1 < flat.portals.size() && vertex_of(last + 1) == vertex && opposite(last) != after) ++last;

  OtherSide out;
  out.first_face = first;
  out.last_face = last + 1;
  const std::uint32_t goal = strip.faces[last + 1];
  std::uint32_t face = strip.faces[first];
  std::uint32_t edge = strip.edges[first];
  out.around.faces.push_back(face);
  out.angle_rad = corner_angle(mesh, face, vertex) - angle_between(before - place, opposite(first) - place) +
                  corner_angle(mesh, goal, vertex) - angle_between(after - place, opposite(last) - place);
  for (std::size_t turns = adjacency.triangles_of_vertex(vertex).size(); turns > 0; --turns) {
    for (const std::uint32_t next : adjacency.edge_of_triangle[face]) {
      const auto& ends = adjacency.edge_vertices[next];
      if (next != edge && (ends[0] == vertex || ends[1] == vertex)) {
        edge = next;
        break;
      }
    }
    const auto triangles = adjacency.triangles_of_edge(edge);
    if (triangles.size() != 2) return std::nullopt;
    face = triangles[0] == face ? triangles[1] : triangles[0];
    out.around.edges.push_back(edge);
    out.around.faces.push_back(face);
    if (face == goal) return out;
    out.angle_rad += corner_angle(mesh, face, vertex);
    if (out.angle_rad >= std::numbers::pi) return std::nullopt;
  }
  return std::nullopt;
}

// Cuts out the triangles that the strip enters and leaves by the same edge.
void remove_dead_ends(TriangleStrip& strip) {
  TriangleStrip out{{strip.faces[0]}, {}};
  for (std::size_t i = 0; i < strip.edges.size(); ++i) {
    if (!out.edges.empty() && out.edges.back() == strip.edges[i]) {
      out.faces.pop_back();
      if (out.faces.back() == strip.faces[i + 1]) {
        out.edges.pop_back();
      } else {
        out.faces.push_back(strip.faces[i + 1]);
      }
    } else {
      out.edges.push_back(strip.edges[i]);
      out.faces.push_back(strip.faces[i + 1]);
    }
  }
  strip = std::move(out);
}

TriangleStrip rerouted(const TriangleStrip& strip, const OtherSide& side) {
  TriangleStrip out;
  const auto offset = [](std::size_t i) { return static_cast<std::ptrdiff_t>(i); };
  out.faces.assign(strip.faces.begin(), strip.faces.begin() + offset(side.first_face));
  out.faces.insert(out.faces.end(), side.around.faces.begin(), side.around.faces.end());
  out.faces.insert(out.faces.end(), strip.faces.begin() + offset(side.last_face + 1), strip.faces.end());
  out.edges.assign(strip.edges.begin(), strip.edges.begin() + offset(side.first_face));
  out.edges.insert(out.edges.end(), side.around.edges.begin(), side.around.edges.end());
  out.edges.insert(out.edges.end(), strip.edges.begin() + offset(side.last_face), strip.edges.end());
  remove_dead_ends(out);
  return out;
}

Vector2d place_of(const UnfoldedStrip& flat, const Bend& bend) {
  return bend.left ? flat.portals[bend.portal].left : flat.portals[bend.portal].right;
}

// The bend with least surface on its other side, if that is less than a straight angle.
std::optional<OtherSide> best_detour(const TriangleMesh& mesh, const MeshAdjacency& adjacency,
                                     const TriangleStrip& strip, const UnfoldedStrip& flat,
                                     const std::vector<Bend>& bends) {
  std::optional<OtherSide> best;
  for (std::size_t i = 0; i < bends.size(); ++i) {
    const Vector2d place = place_of(flat, bends[i]);
    // Bends that follow one another at one vertex are one.
    Vector2d before = flat.from;
    for (std::size_t j = i; j-- > 0;) {
      if (place_of(flat, bends[j]) != place) {
        before = place_of(flat, bends[j]);
        break;
      }
    }
    Vector2d after = flat.to;
    for (std::size_t j = i + 1; j < bends.size(); ++j) {
      if (place_of(flat, bends[j]) != place) {
        after = place_of(flat, bends[j]);
        break;
      }
    }
    if (before == place || after == place) continue;
    auto side = other_side(mesh, adjacency, strip, flat, bends[i], before, after);
    if (!side || side->angle_rad >= std::numbers::pi - kAngleTol_rad) continue;
    if (!best || side->angle_rad < best->angle_rad) best = std::move(side);
  }
  return best;
}

// The straightened path: its ends, bends and every crossing of an edge, each point once.
MeshPath trace_strip(const TriangleMesh& mesh, const TriangleStrip& strip, const UnfoldedStrip& flat,
                     const std::vector<Bend>& bends, const Vector3d& from, const Vector3d& to) {
  MeshPath path;
  const auto add = [&path](const Vector3d& p, std::uint32_t triangle) {
    if (!path.p_mesh_m.empty() && p == path.p_mesh_m.back()) {
      path.triangle.back() = triangle;
      return;
    }
    path.s_m.push_back(path.p_mesh_m.empty() ? 0.0 : path.s_m.back() + (p - path.p_mesh_m.back()).norm());
    path.p_mesh_m.push_back(p);
    path.triangle.push_back(triangle);
  };
  add(from, strip.faces.front());
  std::size_t next_bend = 0;
  Vector2d begin = flat.from;
  double reached = 0.0;  // of the way from `begin` to the next bend
  for (std::size_t i = 0; i < flat.portals.size(); ++i) {
    const Portal& portal = flat.portals[i];
    while (next_bend < bends.size() && bends[next_bend].portal < i) {
      begin = place_of(flat, bends[next_bend++]);
      reached = 0.0;
    }
    const Vector2d end = next_bend < bends.size() ? place_of(flat, bends[next_bend]) : flat.to;
    const Vector2d edge = portal.left - portal.right;
    const Vector2d along = end - begin;
    const double over = along.x() * edge.y() - along.y() * edge.x();
    const Vector2d out = begin - portal.right;
    double u = over != 0.0 ? std::clamp((along.x() * out.y() - along.y() * out.x()) / over, 0.0, 1.0) : 0.0;
    // Where the path runs along an edge, rounding decides where they meet: never behind the last crossing.
    const double square = along.squaredNorm();
    const double t = square > 0.0 ? (portal.right + u * edge - begin).dot(along) / square : 0.0;
    const double kept = std::clamp(t, reached, 1.0);
    if (kept != t && edge.squaredNorm() > 0.0) {
      u = std::clamp((begin + kept * along - portal.right).dot(edge) / edge.squaredNorm(), 0.0, 1.0);
    }
    reached = kept;
    // A bend lies on the vertex itself, and so does the path at every edge it turns over there.
    for (const Vector2d& at : {begin, end}) {
      if (at == portal.left) u = 1.0;
      if (at == portal.right) u = 0.0;
    }
    const Vector3d& right = mesh.vertices_m[portal.right_vertex];
    const Vector3d& left = mesh.vertices_m[portal.left_vertex];
    add(u == 1.0 ? left : right + u * (left - right), strip.faces[i + 1]);
  }
  add(to, strip.faces.back());
  if (path.size() == 1) {  // from and to are the same point
    path.p_mesh_m.push_back(to);
    path.triangle.push_back(strip.faces.back());
    path.s_m.push_back(0.0);
  }
  return path;
}

}  // namespace

GeodesicPath geodesic_path(const TriangleMesh& mesh, const MeshAdjacency& adjacency, const MeshPoint& from,
                           const MeshPoint& to, const Observer& observer) {
  check_mesh_point(mesh, adjacency, from);
  check_mesh_point(mesh, adjacency, to);
  const Vector3d start = position_m(mesh, from);
  const Vector3d goal = position_m(mesh, to);
  TriangleStrip strip = find_strip(mesh, adjacency, from, to);
  GeodesicPath out;
  const auto limit = static_cast<int>(std::min<std::size_t>(1000 + 10 * strip.faces.size(), 1'000'000));
  for (;;) {
    observer.update("path", 0.0);
    const UnfoldedStrip flat = unfold_strip(mesh, adjacency, strip, start, goal);
    const std::vector<Bend> bends = shortest_bends(flat);
    const auto detour = best_detour(mesh, adjacency, strip, flat, bends);
    if (!detour || out.detours == limit) {
      out.locally_shortest = !detour;
      out.path = trace_strip(mesh, strip, flat, bends, start, goal);
      return out;
    }
    strip = rerouted(strip, *detour);
    ++out.detours;
  }
}

GeodesicPath geodesic_path(const TriangleMesh& mesh, const MeshAdjacency& adjacency, std::span<const MeshPoint> through,
                           const Observer& observer) {
  if (through.size() < 2)
    throw Error("geodesic path: " + std::to_string(through.size()) + " points; at least two are needed");
  GeodesicPath out;
  for (std::size_t i = 0; i + 1 < through.size(); ++i) {
    const GeodesicPath piece = geodesic_path(mesh, adjacency, through[i], through[i + 1], observer);
    out.locally_shortest &= piece.locally_shortest;
    out.detours += piece.detours;
    const double so_far_m = i == 0 ? 0.0 : out.path.s_m.back();
    if (i > 0) out.path.triangle.back() = piece.path.triangle.front();
    for (std::size_t k = i == 0 ? 0 : 1; k < piece.path.size(); ++k) {
      out.path.p_mesh_m.push_back(piece.path.p_mesh_m[k]);
      out.path.triangle.push_back(piece.path.triangle[k]);
      out.path.s_m.push_back(so_far_m + piece.path.s_m[k]);
    }
  }
  return out;
}

}  // namespace asperity
