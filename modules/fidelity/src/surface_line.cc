#include "asperity/fidelity/surface_stroke.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <Eigen/Geometry>

#include "asperity/base/error.h"
#include "asperity/geometry/mesh_surface.h"
#include "asperity/geometry/straight_path.h"
#include "asperity/scene/paint.h"

namespace asperity {

using Eigen::Vector3d;

namespace {

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

  // A point of `triangle`; the way to it from the one before leads over `over`.
  void add(std::uint32_t triangle, const Vector3d& barycentric, std::uint32_t over) {
    const Vector3d p_world_m = object_->T_world_mesh * position_m(surface_->mesh, {triangle, barycentric});
    const double s_m = line_.size() == 0 ? 0.0 : length_m() + (p_world_m - line_.p_world_m.back()).norm();
    if (line_.size() > 0 && !(s_m > length_m())) return;
    Vector3d normal = weighted(surface_->normals[triangle], barycentric);
    if (!(normal.squaredNorm() > 0.0)) {
      if (line_.size() == 0) return;
      normal = object_->T_world_mesh.rotation.conjugate() * line_.n_world.back();
    }
    line_.p_world_m.push_back(p_world_m);
    line_.n_world.push_back(object_->T_world_mesh.rotation * normal.normalized());
    line_.s_m.push_back(s_m);
    const Vector3d piece = weighted(surface_->normals[over], Vector3d::Ones());
    piece_n_world_.push_back(object_->T_world_mesh.rotation * piece.normalized());
  }

  void add(const MeshPath& path) {
    for (std::size_t i = 0; i < path.size(); ++i) {
      const ClosestPoint on = surface_->bvh.closest_point(path.p_mesh_m[i]);
      if (on.found()) add(on.triangle, on.barycentric, path.triangle[i == 0 ? 0 : i - 1]);
    }
  }

  bool empty() const { return line_.size() == 0; }
  double length_m() const { return line_.size() == 0 ? 0.0 : line_.s_m.back(); }
  const Vector3d& end_world_m() const { return line_.p_world_m.back(); }
  SurfaceLine take() { return std::move(line_); }

  // The part about the piece at `s_m` of which no piece turns away from that one.
  SurfaceLine take_facing(double s_m) {
    if (line_.size() < 2) return take();
    const auto after = std::upper_bound(line_.s_m.begin() + 1, line_.s_m.end() - 1, s_m);
    const auto middle = static_cast<std::size_t>(after - line_.s_m.begin());
    const auto faces = [&](std::size_t i) {
      return piece_n_world_[i].dot(piece_n_world_[middle]) >= kLeastFacingCosine;
    };
    std::size_t first = middle - 1, last = middle;
    while (first > 0 && faces(first)) --first;
    while (last + 1 < line_.size() && faces(last + 1)) ++last;
    SurfaceLine out;
    out.turns_away = first > 0 || last + 1 < line_.size();
    for (std::size_t i = first; i <= last; ++i) {
      out.p_world_m.push_back(line_.p_world_m[i]);
      out.n_world.push_back(line_.n_world[i]);
      out.s_m.push_back(line_.s_m[i] - line_.s_m[first]);
    }
    // A point on an edge may have the normal of the other side.
    const auto face = [&](Vector3d& n, std::size_t piece) {
      if (n.dot(piece_n_world_[middle]) < kLeastFacingCosine) n = piece_n_world_[piece];
    };
    for (std::size_t i = first; i <= last; ++i) face(out.n_world[i - first], i == first ? first + 1 : i);
    return out;
  }

 private:
  static constexpr double kLeastFacingCosine = 0.5;  // 60 degrees

  const SceneObject* object_;
  const MeshSurface* surface_;
  SurfaceLine line_;
  std::vector<Vector3d> piece_n_world_;  // of the surface on the way to each point
};

const SceneObject& first_object(const Scene& scene) {
  if (scene.objects.empty()) throw Error("stroke: the scene has no object");
  return scene.objects.front();
}

// The longest of the lines that pieces sorted by x join to. A texture that is laid in several strokes has several at
// the same x, so each piece goes to the line that ends nearest to it.
SurfaceLine longest_line(const SceneObject& object, const std::vector<LevelPiece>& pieces) {
  struct OpenLine {
    LineMaker maker;
    double reached_mm;
  };
  constexpr std::size_t kMostOpen = 64;  // bounds the search; more strokes side by side have the lowest closed
  const MeshSurface surface(to_metres(object.mesh, object.unit_m));
  const double joined_m = 0.1 * mean_length_m(pieces);
  std::vector<OpenLine> open;
  SurfaceLine longest;
  const auto finish = [&](OpenLine& line) {
    const double middle_m = 0.5 * line.maker.length_m();
    SurfaceLine done = line.maker.take_facing(middle_m);
    if (done.size() > 1 && (longest.size() < 2 || done.s_m.back() > longest.s_m.back())) longest = std::move(done);
  };
  for (const LevelPiece& piece : pieces) {
    const Vector3d start_m = object.T_world_mesh * position_m(surface.mesh, {piece.triangle, piece.barycentric[0]});
    const auto gap_m = [&](OpenLine& line) { return (start_m - line.maker.end_world_m()).norm(); };
    auto best =
        std::min_element(open.begin(), open.end(), [&](OpenLine& a, OpenLine& b) { return gap_m(a) < gap_m(b); });
    // Pieces that follow one another meet at an edge; what lies further off is another part of the texture.
    if (best == open.end() || gap_m(*best) > joined_m) {
      if (open.size() == kMostOpen) {
        const auto oldest = std::min_element(
            open.begin(), open.end(), [](const OpenLine& a, const OpenLine& b) { return a.reached_mm < b.reached_mm; });
        finish(*oldest);
        open.erase(oldest);
      }
      LineMaker maker(object, surface);
      maker.add(piece.triangle, piece.barycentric[0], piece.triangle);
      if (maker.empty()) continue;
      open.push_back({std::move(maker), piece.x_mm[0]});
      best = open.end() - 1;
    }
    best->maker.add(piece.triangle, piece.barycentric[0], piece.triangle);
    best->maker.add(piece.triangle, piece.barycentric[1], piece.triangle);
    best->reached_mm = piece.x_mm[1];
  }
  for (OpenLine& line : open) finish(line);
  return longest;
}

}  // namespace

SurfaceLine textured_line(const Scene& scene) {
  for (const SceneObject& object : scene.objects) {
    if (object.mesh.haptic.size() != object.mesh.triangles.size()) continue;
    for (const SceneTexture& texture : object.textures) {
      const std::vector<LevelPiece> pieces = level_pieces(object, texture.index);
      if (pieces.empty()) continue;
      SurfaceLine longest = longest_line(object, pieces);
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
  std::reverse(path.triangle.begin(), path.triangle.end() - 1);  // piece i lies in triangle i
  maker.add(path);
  const double middle_m = maker.length_m();
  maker.add(straight_path(surface.mesh, surface.adjacency, middle, along, half_m).path);
  return maker.take_facing(middle_m);
}

}  // namespace asperity
