#include "asperity/registration/haptic_coordinates.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <tuple>

#include "asperity/base/error.h"
#include "asperity/base/rounded_text.h"
#include "asperity/base/text.h"
#include "asperity/registration/triangle_stretch.h"
#include "fit_along_path.h"
#include "near_path.h"
#include "path_foot.h"
#include "surface_path.h"

namespace asperity {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

void check_paths(const TriangleMesh& mesh, const MeshAdjacency& adjacency, const std::vector<MeshPath>& paths) {
  if (adjacency.edge_of_triangle.size() != mesh.triangles.size())
    throw Error("haptic coordinates: the adjacency is of another mesh");
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const MeshPath& path = paths[i];
    if (path.size() == 0 && path.triangle.empty() && path.s_m.empty()) continue;
    const std::string name = "haptic coordinates: path " + std::to_string(i + 1);
    if (path.triangle.size() != path.size() || path.s_m.size() != path.size())
      throw Error(name + ": unequal counts of points, triangles and lengths");
    if (path.size() < 2) throw Error(name + ": " + std::to_string(path.size()) + " points; at least two are needed");
    for (std::size_t k = 0; k < path.size(); ++k) {
      const std::string place = name + ", point " + std::to_string(k + 1);
      if (!path.p_mesh_m[k].allFinite() || !std::isfinite(path.s_m[k])) throw Error(place + ": not finite");
      if (path.triangle[k] >= mesh.triangles.size())
        throw Error(place + ": triangle " + std::to_string(path.triangle[k]) + " of " +
                    std::to_string(mesh.triangles.size()));
      if (k > 0 && path.s_m[k] < path.s_m[k - 1])
        throw Error(place + ": s_m falls from " + number_text(path.s_m[k - 1]) + " to " + number_text(path.s_m[k]));
    }
    if (!(path.s_m.back() > path.s_m.front())) throw Error(name + ": it has no length");
  }
}

// Fills in the numbers and lists of stretch and folds of the triangles `chosen`. Seen from outside, x × y
// points inwards (erratum 17): a map that keeps the triangle's turn is a fold.
void measure_warp(const TriangleMesh& mesh, std::span<const std::uint32_t> chosen,
                  const std::vector<HapticTriangle>& triangles, double stretch_limit, HapticWarp& warp) {
  warp.triangles = chosen.size();
  double square = 0.0;
  double area = 0.0;
  bool first = true;
  for (const std::uint32_t t : chosen) {
    const TriangleStretch one = triangle_stretch(mesh, t, triangles[t]);
    if (!one.known) continue;
    warp.stretch_min = first ? one.low : std::min(warp.stretch_min, one.low);
    warp.stretch_max = first ? one.high : std::max(warp.stretch_max, one.high);
    first = false;
    square += one.area_m2 * ((one.high - 1.0) * (one.high - 1.0) + (one.low - 1.0) * (one.low - 1.0)) / 2.0;
    area += one.area_m2;
    if (one.folded) warp.folded.push_back(t);
    if (one.high > stretch_limit || one.low * stretch_limit < 1.0) warp.stretched.push_back(t);
  }
  warp.stretch_rms = area > 0.0 ? std::sqrt(square / area) : 0.0;
}

double mean_edge_m(const TriangleMesh& mesh, const std::vector<std::uint32_t>& triangles) {
  double sum = 0.0;
  for (const std::uint32_t t : triangles) {
    for (std::size_t e = 0; e < 3; ++e) {
      sum += (mesh.vertices_m[mesh.triangles[t][(e + 1) % 3]] - mesh.vertices_m[mesh.triangles[t][e]]).norm() / 3.0;
    }
  }
  return sum / static_cast<double>(triangles.size());
}

// The coordinates about one path: a foot on the path itself, or past its ends on its straight continuation.
class PathCoordinates {
 public:
  PathCoordinates(const TriangleMesh& mesh, const MeshAdjacency& adjacency, const SurfacePath& path, double extent_m)
      : before_(extend_path(mesh, adjacency, path, true, extent_m)),
        after_(extend_path(mesh, adjacency, path, false, extent_m)),
        feet_(mesh, adjacency, path.pieces),
        feet_before_(mesh, adjacency, before_),
        feet_after_(mesh, adjacency, after_) {}

  // `ask(feet, limit_m, whole)` looks for a point's foot; with `whole` false on the part of the path allowed.
  template <class Ask>
  std::optional<Vector2d> at(Ask&& ask, double limit_m) const {
    const PathFoot foot = ask(feet_, limit_m, false);
    if (!foot.found) return std::nullopt;
    if (!foot.at_start && !foot.at_end) return Vector2d(foot.s_m, foot.across_m);
    const PathFoot further = ask(foot.at_start ? feet_before_ : feet_after_, foot.distance_m * (1.0 + 1e-9), true);
    if (!further.found) return Vector2d(foot.s_m + foot.beyond_m, foot.across_m);
    const bool at_far_end = foot.at_start ? further.at_start : further.at_end;
    return Vector2d(further.s_m + (at_far_end ? further.beyond_m : 0.0), further.across_m);
  }

 private:
  std::vector<PathPiece> before_;
  std::vector<PathPiece> after_;
  PathFeet feet_;
  PathFeet feet_before_;
  PathFeet feet_after_;
};

// One path's coordinates: for the triangles `chosen`, of which `shared` says whether their corners have the
// same coordinates as other triangles' there.
struct OnePath {
  std::vector<HapticTriangle> triangles;
  std::vector<std::uint32_t> chosen;
  std::vector<bool> shared;
  HapticWarp warp;
  std::size_t jumps = 0;
  double from_s_m = 0.0;
  double to_s_m = 0.0;
};

std::vector<bool> touched_triangles(const TriangleMesh& mesh, const MeshAdjacency& adjacency, const SurfacePath& smooth,
                                    double extension_m) {
  std::vector<bool> touched(mesh.triangles.size(), false);
  for (const MeshPoint& p : smooth.points) touched[p.triangle] = true;
  for (const PathPiece& piece : smooth.pieces) touched[piece.triangle] = true;
  for (const bool backwards : {true, false}) {
    for (const PathPiece& piece : extend_path(mesh, adjacency, smooth, backwards, extension_m))
      touched[piece.triangle] = true;
  }
  return touched;
}

// A triangle's corners lie on different parts of the path if x changes faster between them than any bend of
// a path that they lie beside would make it.
bool is_torn(const TriangleMesh& mesh, std::uint32_t t, const std::array<Vector2d, 3>& xy_m) {
  constexpr double kFastest = 4.0;
  for (std::size_t e = 0; e < 3; ++e) {
    const std::size_t next = (e + 1) % 3;
    const double edge_m = (mesh.vertices_m[mesh.triangles[t][next]] - mesh.vertices_m[mesh.triangles[t][e]]).norm();
    if (std::abs(xy_m[next].x() - xy_m[e].x()) > kFastest * edge_m) return true;
  }
  return false;
}

// The corners' coordinates about the part of the path that is nearest to the triangle's middle.
std::array<Vector2d, 3> torn_corners(const TriangleMesh& mesh, std::uint32_t t, const PathCoordinates& coordinates,
                                     const std::array<Vector2d, 3>& xy_m, double limit_m) {
  const Vector3d middle = Vector3d::Constant(1.0 / 3.0);
  double longest_m = 0.0;
  for (std::size_t e = 0; e < 3; ++e) {
    longest_m = std::max(
        longest_m, (mesh.vertices_m[mesh.triangles[t][(e + 1) % 3]] - mesh.vertices_m[mesh.triangles[t][e]]).norm());
  }
  const auto of_middle = coordinates.at(
      [&](const PathFeet& feet, double limit, bool) {
        return feet.of_point({t, middle}, limit);
      },
      limit_m + longest_m);
  if (!of_middle) return xy_m;
  const double from_s_m = of_middle->x() - 4.0 * longest_m;
  const double to_s_m = of_middle->x() + 4.0 * longest_m;
  std::array<Vector2d, 3> out = xy_m;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::uint32_t vertex = mesh.triangles[t][k];
    const auto found = coordinates.at(
        [&](const PathFeet& feet, double limit, bool whole) {
          return whole ? feet.of_vertex(vertex, limit) : feet.of_vertex(vertex, limit, from_s_m, to_s_m);
        },
        limit_m + 6.0 * longest_m);
    if (found) out[k] = *found;
  }
  return out;
}

void measure_fit(const MeshPath& path, const SurfacePath& smooth, OnePath& one) {
  double along = 0.0;
  double across = 0.0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const MeshPoint& p = smooth.points[i];
    const auto& xy_mm = one.triangles[p.triangle].xy_mm;
    const Vector2d xy = p.barycentric[0] * xy_mm[0] + p.barycentric[1] * xy_mm[1] + p.barycentric[2] * xy_mm[2];
    const double missing_m = path.s_m[i] - 1e-3 * xy.x();
    along += missing_m * missing_m;
    across += 1e-6 * xy.y() * xy.y();
    one.warp.along_max_m = std::max(one.warp.along_max_m, std::abs(missing_m));
  }
  one.warp.along_rms_m = std::sqrt(along / static_cast<double>(path.size()));
  one.warp.across_rms_m = std::sqrt(across / static_cast<double>(path.size()));
  one.warp.length_ratio = smooth.length_m / (one.to_s_m - one.from_s_m);
}

OnePath coordinates_along(const TriangleMesh& mesh, const MeshAdjacency& adjacency, const MeshPath& path,
                          const HapticCoordinatesConfig& config, std::int32_t texture) {
  OnePath one;
  one.from_s_m = path.s_m.front();
  one.to_s_m = path.s_m.back();
  std::vector<std::uint32_t> along = path.triangle;
  std::sort(along.begin(), along.end());
  along.erase(std::unique(along.begin(), along.end()), along.end());
  const double edge_m = mean_edge_m(mesh, along);
  if (!(edge_m > 0.0)) throw Error("haptic coordinates: the path is on triangles without area");
  const double half_window_m = std::max(1e-3 * config.smoothing_mm, config.smoothing_edges * edge_m);
  const SurfacePath smooth = make_surface_path(mesh, adjacency, path, half_window_m, edge_m);
  if (smooth.pieces.empty()) throw Error("haptic coordinates: the path stays at one point of the mesh");
  one.jumps = smooth.jumps;

  std::vector<bool> marked = touched_triangles(mesh, adjacency, smooth, 1e-3 * config.extension_mm);
  const std::vector<bool> touched = marked;
  const double half_width_m = 1e-3 * config.half_width_mm;
  std::vector<EdgeDistance> bounds;
  if (half_width_m > 0.0) {
    // Edges lead round; what they overshoot is decided by the true distance below.
    bounds = edge_distances(mesh, adjacency, smooth.pieces, {}, 1.5 * half_width_m + edge_m);
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      for (const std::uint32_t v : mesh.triangles[t])
        marked[t] = marked[t] ||
                    (adjacency.edge_of_triangle[t][0] != MeshAdjacency::kNone && std::isfinite(bounds[v].distance_m));
    }
  } else {
    grow_marked(mesh, adjacency, config.rings, marked);
  }
  bounds = edge_distances(mesh, adjacency, smooth.pieces, marked, std::numeric_limits<double>::infinity());

  double furthest_m = 0.0;
  for (const EdgeDistance& bound : bounds) {
    if (std::isfinite(bound.distance_m)) furthest_m = std::max(furthest_m, bound.distance_m);
  }
  const PathCoordinates coordinates(mesh, adjacency, smooth, furthest_m + 1e-3 * config.extension_mm);
  std::vector<Vector2d> xy_m(mesh.vertices_m.size());
  std::vector<bool> known(mesh.vertices_m.size(), false);
  const auto coordinate = [&](std::uint32_t vertex) {
    if (known[vertex]) return;
    known[vertex] = true;
    const EdgeDistance& bound = bounds[vertex];
    const auto found =
        coordinates.at([vertex](const PathFeet& feet, double limit, bool) { return feet.of_vertex(vertex, limit); },
                       bound.distance_m * (1.0 + 1e-9));
    xy_m[vertex] = found ? *found : Vector2d(bound.s_m, bound.across * bound.distance_m);
  };

  one.triangles.assign(mesh.triangles.size(), {});
  one.shared.assign(mesh.triangles.size(), true);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!marked[t]) continue;
    std::array<Vector2d, 3> corners;
    double nearest_m = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < 3; ++k) {
      coordinate(mesh.triangles[t][k]);
      corners[k] = xy_m[mesh.triangles[t][k]];
      const double past_m = std::max({0.0, one.from_s_m - corners[k].x(), corners[k].x() - one.to_s_m});
      nearest_m = std::min(nearest_m, std::hypot(corners[k].y(), past_m));
    }
    if (half_width_m > 0.0 && nearest_m > half_width_m && !touched[t]) continue;
    one.chosen.push_back(t);
    if (is_torn(mesh, t, corners)) {
      one.shared[t] = false;
      one.warp.overlapping.push_back(t);
      double limit_m = 0.0;
      for (const std::uint32_t v : mesh.triangles[t]) limit_m = std::max(limit_m, bounds[v].distance_m);
      corners = torn_corners(mesh, t, coordinates, corners, limit_m);
    }
    one.triangles[t].texture = texture;
    for (std::size_t k = 0; k < 3; ++k) one.triangles[t].xy_mm[k] = 1e3 * corners[k];
  }
  if (config.fit_smoothness > 0.0)
    fit_along_path(mesh, smooth.pieces, edge_m, config.fit_smoothness, one.chosen, one.shared, one.triangles);
  measure_warp(mesh, one.chosen, one.triangles, config.stretch_limit, one.warp);
  measure_fit(path, smooth, one);
  return one;
}

double distance_mm(const OnePath& path, std::uint32_t t) {
  const auto& corners = path.triangles[t].xy_mm;
  const Vector2d middle = (corners[0] + corners[1] + corners[2]) / 3.0;
  const double past_mm = std::max({0.0, 1e3 * path.from_s_m - middle.x(), middle.x() - 1e3 * path.to_s_m});
  return std::hypot(past_mm, middle.y());
}

void append_warp_problems(const HapticWarp& warp, std::size_t jumps, std::size_t path, Problems& problems) {
  const auto add = [&](const char* kind, std::size_t count, const std::string& what) {
    if (count > 0)
      problems.push_back({kind, "path " + std::to_string(path) + ": " + std::to_string(count) + " " + what, count});
  };
  add("path_jumps", jumps, "of its points lie further from the one before than its length allows");
  add("coordinates_fold", warp.folded.size(), "triangles where the texture folds over");
  add("coordinates_stretch", warp.stretched.size(),
      "triangles where the texture is squeezed or stretched: " + rounded_text(warp.stretch_min) + " to " +
          rounded_text(warp.stretch_max) + " times the surface's lengths");
  add("coordinates_overlap", warp.overlapping.size(), "triangles between two parts of the path");
}

}  // namespace

HapticCoordinates assign_haptic_coordinates(const TriangleMesh& mesh, const MeshAdjacency& adjacency,
                                            const std::vector<MeshPath>& paths, const HapticCoordinatesConfig& config) {
  check_paths(mesh, adjacency, paths);
  HapticCoordinates out;
  out.triangles.assign(mesh.triangles.size(), {});
  std::vector<double> nearest_mm(mesh.triangles.size(), std::numeric_limits<double>::infinity());
  std::vector<bool> contested(mesh.triangles.size(), false);
  struct Loser {
    CoveredTriangle claim;
    double apart_mm = 0.0;
  };
  std::vector<Loser> losers;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    if (paths[i].size() == 0) {
      out.warps.emplace_back();
      continue;
    }
    const OnePath one = coordinates_along(mesh, adjacency, paths[i], config, static_cast<std::int32_t>(i + 1));
    for (const std::uint32_t t : one.chosen) {
      if (out.triangles[t].texture >= 0 && !contested[t]) {
        contested[t] = true;
        ++out.contested;
      }
      const double apart_mm = distance_mm(one, t);
      if (apart_mm >= nearest_mm[t]) {
        losers.push_back({{t, one.triangles[t]}, apart_mm});
        continue;
      }
      if (out.triangles[t].texture >= 0) losers.push_back({{t, out.triangles[t]}, nearest_mm[t]});
      nearest_mm[t] = apart_mm;
      out.triangles[t] = one.triangles[t];
    }
    append_warp_problems(one.warp, one.jumps, i + 1, out.problems);
    out.warps.push_back(one.warp);
  }
  // Of paths equally far the first is the nearest.
  std::sort(losers.begin(), losers.end(), [](const Loser& a, const Loser& b) {
    return std::tuple(a.claim.triangle, -a.apart_mm, -a.claim.haptic.texture) <
           std::tuple(b.claim.triangle, -b.apart_mm, -b.claim.haptic.texture);
  });
  for (const Loser& loser : losers) out.covered.push_back(loser.claim);
  if (out.contested > 0) {
    out.problems.push_back({"coordinates_contested",
                            std::to_string(out.contested) + " triangles are near several paths; the nearest has them",
                            out.contested});
  }
  return out;
}

}  // namespace asperity
