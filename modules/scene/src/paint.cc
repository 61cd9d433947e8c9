#include "asperity/scene/paint.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <Eigen/Geometry>

#include "asperity/base/error.h"
#include "asperity/base/rounded_text.h"
#include "asperity/base/version.h"
#include "asperity/geometry/connected_point.h"
#include "asperity/geometry/geodesic_path.h"
#include "asperity/geometry/mesh_surface.h"

namespace asperity {
namespace {

using Eigen::Vector3d;

// Points of a path at even steps, none longer than a quarter of its mean piece between two edges.
MeshPath evenly_spaced(const MeshPath& path) {
  const double length_m = path.s_m.back();
  const auto pieces = static_cast<double>(path.size() - 1);
  const auto steps = static_cast<std::size_t>(std::clamp(4.0 * pieces, 40.0, 1e5));
  MeshPath out;
  std::size_t piece = 0;
  for (std::size_t k = 0; k <= steps; ++k) {
    const double s_m = k == steps ? length_m : length_m * static_cast<double>(k) / static_cast<double>(steps);
    while (piece + 2 < path.size() && path.s_m[piece + 1] <= s_m) ++piece;
    const double piece_m = path.s_m[piece + 1] - path.s_m[piece];
    const double u = piece_m > 0.0 ? std::clamp((s_m - path.s_m[piece]) / piece_m, 0.0, 1.0) : 0.0;
    out.p_mesh_m.push_back((1.0 - u) * path.p_mesh_m[piece] + u * path.p_mesh_m[piece + 1]);
    out.triangle.push_back(path.triangle[piece]);
    out.s_m.push_back(s_m);
  }
  return out;
}

VirtualPath path_through(const MeshSurface& surface, std::span<const Vector3d> picks_mesh_m, const Observer& observer) {
  if (picks_mesh_m.size() < 2)
    throw Error("paint: " + std::to_string(picks_mesh_m.size()) + " points; at least two are needed");
  VirtualPath out;
  std::vector<MeshPoint> through;
  for (const Vector3d& pick : picks_mesh_m) {
    const ClosestPoint nearest = surface.bvh.closest_point(pick);
    if (!nearest.found()) throw Error("paint: point " + std::to_string(through.size() + 1) + " is not finite");
    through.push_back(connected_point(surface.mesh, surface.adjacency, nearest.triangle, nearest.p_m));
    out.pick_distance_m.push_back(nearest.distance_m);
  }
  const GeodesicPath shortest = geodesic_path(surface.mesh, surface.adjacency, through, observer);
  if (!(shortest.path.s_m.back() > 0.0)) throw Error("paint: the points fall together on the mesh");
  out.locally_shortest = shortest.locally_shortest;
  out.path = evenly_spaced(shortest.path);
  return out;
}

// A pick that was meant to be on the surface is within what rounding and a mouse do.
void warn_of_distant_picks(const TriangleMesh& mesh, PaintResult& out) {
  constexpr double kNear = 0.02;  // of the mesh's size
  Eigen::AlignedBox3d box;
  for (const Vector3d& vertex : mesh.vertices_m) box.extend(vertex);
  for (std::size_t i = 0; i < out.path.pick_distance_m.size(); ++i) {
    const double distance_m = out.path.pick_distance_m[i];
    if (distance_m <= kNear * box.diagonal().norm()) continue;
    out.problems.push_back(
        {"pick_off_surface",
         "point " + std::to_string(i + 1) + " is " + rounded_text(1e3 * distance_m, 3) +
             " mm from the surface: the path goes through the nearest point of it; check the points and their unit",
         1});
  }
}

// A further stroke with a texture that the object has is added to its strokes.
void set_origin(const SceneObject& object, std::span<const Vector3d> picks_mesh_m, SceneTexture& texture) {
  TextureOrigin origin = texture.origin.value_or(TextureOrigin{});
  const SceneTexture* before = object.find_texture(texture.index);
  origin.strokes_mesh_m.clear();
  if (before != nullptr && before->origin && before->origin->kind == kPaintedOrigin)
    origin.strokes_mesh_m = before->origin->strokes_mesh_m;
  origin.strokes_mesh_m.emplace_back(picks_mesh_m.begin(), picks_mesh_m.end());
  origin.kind = kPaintedOrigin;
  if (origin.name.empty()) origin.name = texture.texture.name;
  origin.version = kVersion;
  texture.origin = std::move(origin);
}

}  // namespace

VirtualPath virtual_path(const TriangleMesh& mesh, std::span<const Vector3d> picks_mesh_m) {
  return path_through(MeshSurface(mesh), picks_mesh_m, {});
}

PaintResult paint(SceneObject& object, std::span<const Vector3d> picks_mesh_m, SceneTexture texture,
                  const HapticCoordinatesConfig& config, LayAt at, const Observer& observer) {
  if (texture.index < 0) throw Error("paint: texture index " + std::to_string(texture.index) + " is negative");
  observer.update("painting", 0.0);
  const MeshSurface surface(to_metres(object.mesh, object.unit_m), observer);
  PaintResult out;
  out.path = path_through(surface, picks_mesh_m, observer);
  observer.update("painting", 0.5);
  HapticCoordinates coordinates = assign_haptic_coordinates(surface.mesh, surface.adjacency, {out.path.path}, config);
  out.warp = std::move(coordinates.warps[0]);
  out.problems = std::move(coordinates.problems);
  observer.update("painting", 0.9);
  warn_of_distant_picks(surface.mesh, out);
  if (!out.path.locally_shortest)
    out.problems.push_back({"path_not_shortest", "the path between two points could still be shortened", 1});

  texture.order = further_order(object, at, texture.index);
  set_origin(object, picks_mesh_m, texture);
  std::vector<CoveredTriangle> claims;
  for (std::uint32_t t = 0; t < coordinates.triangles.size(); ++t) {
    if (coordinates.triangles[t].texture < 0) continue;
    claims.push_back({t, coordinates.triangles[t]});
    claims.back().haptic.texture = texture.index;
  }
  put_texture(object, std::move(texture));
  const LaidTriangles laid = lay_triangles(object, claims);
  out.painted_over = laid.over;
  out.covered = covered_textures(object, laid);
  out.painted_under = laid.under;
  return out;
}

}  // namespace asperity
