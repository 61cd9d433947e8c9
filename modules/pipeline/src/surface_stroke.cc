#include "asperity/pipeline/surface_stroke.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <Eigen/Geometry>

#include "asperity/base/error.h"
#include "asperity/base/units.h"
#include "asperity/geometry/mesh_surface.h"
#include "asperity/geometry/straight_path.h"
#include "asperity/scene/paint.h"

namespace asperity {

using Eigen::Vector3d;

namespace {

const SceneObject& first_object(const Scene& scene) {
  if (scene.objects.empty()) throw Error("stroke: the scene has no object");
  return scene.objects.front();
}

// Where a triangle's texture has the wanted y: from the lower x to the higher.
struct LevelPiece {
  std::array<double, 2> x_mm;
  std::array<Vector3d, 2> barycentric;
  std::uint32_t triangle;
};

std::optional<LevelPiece> level_piece(const HapticTriangle& haptic, std::uint32_t triangle, double y_mm) {
  LevelPiece out{{}, {}, triangle};
  std::size_t found = 0;
  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3;
    const Eigen::Vector2d& a = haptic.xy_mm[static_cast<std::size_t>(k)];
    const Eigen::Vector2d& b = haptic.xy_mm[static_cast<std::size_t>(next)];
    if ((a.y() >= y_mm) == (b.y() >= y_mm)) continue;
    const double share = (y_mm - a.y()) / (b.y() - a.y());
    out.x_mm[found] = a.x() + share * (b.x() - a.x());
    out.barycentric[found] = Vector3d::Zero();
    out.barycentric[found][k] = 1.0 - share;
    out.barycentric[found][next] = share;
    ++found;
  }
  if (found != 2) return std::nullopt;
  if (out.x_mm[0] > out.x_mm[1]) {
    std::swap(out.x_mm[0], out.x_mm[1]);
    std::swap(out.barycentric[0], out.barycentric[1]);
  }
  if (!std::isfinite(out.x_mm[0]) || !std::isfinite(out.x_mm[1])) return std::nullopt;
  return out;
}

std::vector<LevelPiece> level_pieces(const SceneObject& object, int texture) {
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
  for (const HapticTriangle& triangle : object.mesh.haptic) {
    if (triangle.texture != texture) continue;
    for (const Eigen::Vector2d& corner : triangle.xy_mm) {
      lowest = std::min(lowest, corner.y());
      highest = std::max(highest, corner.y());
    }
  }
  // Coordinates that all lie on one side have their line in their middle. A hair's breadth beside it, for a path
  // along edges of the mesh has their corners on either side of 0 by rounding.
  constexpr double kBeside = 1e-3;
  const double y_mm = (lowest < 0.0 && highest > 0.0 ? 0.0 : 0.5 * (lowest + highest)) + kBeside * (highest - lowest);
  std::vector<LevelPiece> out;
  for (std::uint32_t t = 0; t < object.mesh.haptic.size(); ++t) {
    if (object.mesh.haptic[t].texture != texture) continue;
    if (const auto piece = level_piece(object.mesh.haptic[t], t, y_mm)) out.push_back(*piece);
  }
  std::sort(out.begin(), out.end(), [](const LevelPiece& a, const LevelPiece& b) {
    return a.x_mm < b.x_mm || (a.x_mm == b.x_mm && a.triangle < b.triangle);
  });
  return out;
}

double mean_length_m(const std::vector<LevelPiece>& pieces) {
  double sum_mm = 0.0;
  for (const LevelPiece& piece : pieces) sum_mm += piece.x_mm[1] - piece.x_mm[0];
  return 1e-3 * sum_mm / static_cast<double>(pieces.size());
}

Vector3d weighted(const std::array<Vector3d, 3>& corners, const Vector3d& weights) {
  return weights[0] * corners[0] + weights[1] * corners[1] + weights[2] * corners[2];
}

// Collects points of one object as a line in the scene's world.
class LineMaker {
 public:
  LineMaker(const SceneObject& object, const MeshSurface& surface) : object_(&object), surface_(&surface) {}

  void add(std::uint32_t triangle, const Vector3d& barycentric) {
    const Vector3d p_world_m = object_->T_world_mesh * position_m(surface_->mesh, {triangle, barycentric});
    const double s_m = line_.size() == 0 ? 0.0 : line_.s_m.back() + (p_world_m - line_.p_world_m.back()).norm();
    if (line_.size() > 0 && !(s_m > line_.s_m.back())) return;
    Vector3d normal = weighted(surface_->normals[triangle], barycentric);
    if (!(normal.squaredNorm() > 0.0)) {
      if (line_.size() == 0) return;
      normal = object_->T_world_mesh.rotation.conjugate() * line_.n_world.back();
    }
    line_.p_world_m.push_back(p_world_m);
    line_.n_world.push_back(object_->T_world_mesh.rotation * normal.normalized());
    line_.s_m.push_back(s_m);
  }

  void add(const MeshPath& path) {
    for (std::size_t i = 0; i < path.size(); ++i) {
      const ClosestPoint on = surface_->bvh.closest_point(path.p_mesh_m[i]);
      if (on.found()) add(on.triangle, on.barycentric);
    }
  }

  bool empty() const { return line_.size() == 0; }
  const Vector3d& end_world_m() const { return line_.p_world_m.back(); }
  SurfaceLine take() { return std::move(line_); }

 private:
  const SceneObject* object_;
  const MeshSurface* surface_;
  SurfaceLine line_;
};

double length_m(const SurfaceLine& line) { return line.size() < 2 ? 0.0 : line.s_m.back(); }

// The longest of the lines that the pieces, by rising x, join to. Pieces that follow one another meet at an edge of the
// mesh; a texture laid in several strokes has several pieces at the same x.
SurfaceLine longest_line(const SceneObject& object, const std::vector<LevelPiece>& pieces) {
  const MeshSurface surface(to_metres(object.mesh, object.unit_m));
  const double joined_m = 0.1 * mean_length_m(pieces);
  struct OpenLine {
    LineMaker maker;
    double reached_mm;
  };
  std::vector<OpenLine> open;
  SurfaceLine longest;
  const auto finish = [&](OpenLine& line) {
    SurfaceLine whole = line.maker.take();
    if (length_m(whole) > length_m(longest)) longest = std::move(whole);
  };
  for (const LevelPiece& piece : pieces) {
    const Vector3d start_m = object.T_world_mesh * position_m(surface.mesh, {piece.triangle, piece.barycentric[0]});
    OpenLine* nearest = nullptr;
    double nearest_m = joined_m;
    for (std::size_t i = 0; i < open.size();) {
      if (open[i].reached_mm < piece.x_mm[0] - 1e3 * joined_m) {
        finish(open[i]);
        std::swap(open[i], open.back());
        open.pop_back();
        nearest = nullptr;
        nearest_m = joined_m;
        i = 0;
        continue;
      }
      const double gap_m = (start_m - open[i].maker.end_world_m()).norm();
      if (gap_m <= nearest_m) {
        nearest_m = gap_m;
        nearest = &open[i];
      }
      ++i;
    }
    if (nearest == nullptr) {
      open.push_back({LineMaker(object, surface), piece.x_mm[0]});
      open.back().maker.add(piece.triangle, piece.barycentric[0]);
      nearest = &open.back();
    }
    nearest->maker.add(piece.triangle, piece.barycentric[1]);
    nearest->reached_mm = piece.x_mm[1];
    if (nearest->maker.empty()) open.erase(open.begin() + (nearest - open.data()));
  }
  for (OpenLine& line : open) finish(line);
  return longest;
}

// The line's point and normal at an arc length.
struct LinePlace {
  Vector3d p_world_m, n_world;
};
LinePlace place_at(const SurfaceLine& line, double s_m) {
  const auto after = std::upper_bound(line.s_m.begin(), line.s_m.end() - 1, s_m);
  const auto i = static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - line.s_m.begin(), 1)) - 1;
  const double u = std::clamp((s_m - line.s_m[i]) / (line.s_m[i + 1] - line.s_m[i]), 0.0, 1.0);
  return {lerp(line.p_world_m[i], line.p_world_m[i + 1], u),
          lerp(line.n_world[i], line.n_world[i + 1], u).normalized()};
}

// The way along a leg of `length_m` after `t_s`: the speed rises and falls evenly over `ramp_s` at either end.
double way_m(double length_m, double speed_mps, double ramp_s, double t_s) {
  const double leg_s = length_m / speed_mps + ramp_s;
  const auto risen = [&](double t) {
    return t < ramp_s ? 0.5 * speed_mps * t * t / ramp_s : speed_mps * (t - 0.5 * ramp_s);
  };
  return t_s < 0.5 * leg_s ? risen(t_s) : length_m - risen(std::max(leg_s - t_s, 0.0));
}

}  // namespace

SurfaceLine textured_line(const Scene& scene) {
  for (const SceneObject& object : scene.objects) {
    if (object.mesh.haptic.size() != object.mesh.triangles.size()) continue;
    for (const SceneTexture& texture : object.textures) {
      const std::vector<LevelPiece> pieces = level_pieces(object, texture.index);
      if (pieces.empty()) continue;
      const SurfaceLine longest = longest_line(object, pieces);
      if (longest.size() > 1) return longest;
    }
  }
  return {};
}

SurfaceLine line_between(const Scene& scene, const Vector3d& from_world_m, const Vector3d& to_world_m) {
  const SceneObject& object = first_object(scene);
  const Pose T_mesh_world = object.T_world_mesh.inverse();
  const MeshSurface surface(to_metres(object.mesh, object.unit_m));
  const std::array<Vector3d, 2> ends{T_mesh_world * from_world_m, T_mesh_world * to_world_m};
  LineMaker maker(object, surface);
  maker.add(virtual_path(surface.mesh, ends).path);
  return maker.take();
}

SurfaceLine line_across(const Scene& scene, double wanted_m) {
  const SceneObject& object = first_object(scene);
  const MeshSurface surface(to_metres(object.mesh, object.unit_m));
  Eigen::AlignedBox3d box;
  for (const Vector3d& vertex_m : surface.mesh.vertices_m) box.extend(vertex_m);
  Eigen::Index longest = 0, shortest = 0;
  box.sizes().maxCoeff(&longest);
  box.sizes().minCoeff(&shortest);
  if (shortest == longest) shortest = (longest + 2) % 3;
  const Vector3d along = Vector3d::Unit(longest), up = Vector3d::Unit(shortest);
  const double size_m = box.diagonal().norm();
  LineMaker maker(object, surface);
  const RayHit hit = surface.bvh.cast_ray(box.center() + size_m * up, -up);
  MeshPoint middle{hit.triangle, hit.barycentric};
  if (!hit.found()) {
    const ClosestPoint nearest = surface.bvh.closest_point(box.center());
    middle = {nearest.triangle, nearest.barycentric};
  }
  const double half_m = 0.5 * std::min(wanted_m, 2.0 * size_m);
  MeshPath path = straight_path(surface.mesh, surface.adjacency, middle, -along, half_m).path;
  std::reverse(path.p_mesh_m.begin(), path.p_mesh_m.end());
  maker.add(path);
  maker.add(straight_path(surface.mesh, surface.adjacency, middle, along, half_m).path);
  return maker.take();
}

SurfaceLine facing_part(const SurfaceLine& line) {
  if (line.size() < 2) return line;
  constexpr double kLeastCosine = 0.5;  // 60 degrees
  const LinePlace middle = place_at(line, 0.5 * length_m(line));
  const auto faces = [&](std::size_t i) { return line.n_world[i].dot(middle.n_world) >= kLeastCosine; };
  std::size_t first = 0;
  while (first + 1 < line.size() && line.s_m[first + 1] < 0.5 * length_m(line)) ++first;
  std::size_t last = first + 1;
  if (!faces(first) || !faces(last)) return {};
  while (first > 0 && faces(first - 1)) --first;
  while (last + 1 < line.size() && faces(last + 1)) ++last;
  SurfaceLine out;
  for (std::size_t i = first; i <= last; ++i) {
    out.p_world_m.push_back(line.p_world_m[i]);
    out.n_world.push_back(line.n_world[i]);
    out.s_m.push_back(line.s_m[i] - line.s_m[first]);
  }
  return out;
}

SurfaceLine shortened(const SurfaceLine& line, double margin_m) {
  const double length = length_m(line), margin = std::min(margin_m, 0.25 * length);
  if (!(margin > 0.0)) return line;
  SurfaceLine out;
  const auto add = [&](double s_m) {
    const LinePlace place = place_at(line, s_m);
    out.p_world_m.push_back(place.p_world_m);
    out.n_world.push_back(place.n_world);
    out.s_m.push_back(s_m - margin);
  };
  add(margin);
  for (const double s_m : line.s_m) {
    if (s_m > margin && s_m < length - margin) add(s_m);
  }
  add(length - margin);
  return out;
}

HandStroke stroke_along(const SurfaceLine& line, double duration_s, const SurfaceStrokeConfig& config) {
  const double length = length_m(line);
  if (!(length > 0.0)) throw Error("stroke: the line over the surface has no length");
  const double ramp_s = std::min(config.turn_s, length / config.speed_mps);
  const double leg_s = length / config.speed_mps + ramp_s;
  const double start_s = 2.0 * config.approach_s;
  const double whole_s = duration_s > 0.0 ? duration_s : start_s + 2.0 * leg_s;
  constexpr double kStep_s = 1e-3, kLongest_s = 36'000.0;
  if (!(whole_s <= kLongest_s)) throw Error("stroke: it would take longer than ten hours");
  const auto steps = static_cast<std::int64_t>(std::ceil(whole_s / kStep_s));
  HandStroke out;
  out.path.t_ns.reserve(static_cast<std::size_t>(steps) + 1);
  out.path.p_world_m.reserve(static_cast<std::size_t>(steps) + 1);
  out.press_N.reserve(static_cast<std::size_t>(steps) + 1);
  Vector3d inward = Vector3d::Zero();
  for (const Vector3d& normal : line.n_world) inward -= normal;
  out.press_direction_world = inward.norm() > 0.0 ? inward.normalized() : Vector3d(-line.n_world.front());
  out.starts_ns = std::llround(start_s / kNanosecond_s);
  const auto smooth = [](double u) {
    u = std::clamp(u, 0.0, 1.0);
    return u * u * (3.0 - 2.0 * u);
  };
  for (std::int64_t i = 0; i <= steps; ++i) {
    const double t_s = static_cast<double>(i) * kStep_s;
    const double stroke_s = std::max(t_s - start_s, 0.0);
    const double legs = std::floor(stroke_s / leg_s);
    const double way = way_m(length, config.speed_mps, ramp_s, stroke_s - legs * leg_s);
    const bool back = std::fmod(legs, 2.0) == 1.0;
    const LinePlace place = place_at(line, back ? length - way : way);
    const double above_m = (1.0 - smooth(t_s / config.approach_s)) * config.approach_m;
    out.path.t_ns.push_back(i * std::llround(kStep_s / kNanosecond_s));
    out.path.p_world_m.push_back(place.p_world_m + above_m * place.n_world);
    out.press_N.push_back(smooth(t_s / config.approach_s - 1.0) * config.press_N);
  }
  return out;
}

}  // namespace asperity
