#include "asperity/scene/displace_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "asperity/base/error.h"
#include "asperity/base/smoothstep.h"
#include "asperity/base/text.h"
#include "asperity/geometry/mesh_adjacency.h"
#include "asperity/geometry/mesh_normals.h"
#include "asperity/texture/evaluate_height.h"

namespace asperity {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr std::size_t kMostTriangles = 20'000'000;
constexpr std::uint32_t kNone = MeshAdjacency::kNone;

struct Relief {
  const Texture* texture = nullptr;
  double height_offset_m = 0.0;
};

// A new vertex: where it was, and the sum of the heights that its triangles give it.
struct Point {
  Vector3d p_m;
  Vector3d normal;
  double height_m = 0.0;
  int heights = 0;
};

class Displacer {
 public:
  Displacer(const SceneObject& object, const DisplaceMeshConfig& config)
      : object_(object),
        config_(config),
        mesh_(weld_vertices(to_metres(object.mesh, object.unit_m))),
        adjacency_(make_adjacency(mesh_)),
        normals_(vertex_normals(mesh_)) {
    find_reliefs();
    choose_cuts();
  }

  MeshFile run() {
    points_.resize(mesh_.vertices_m.size());
    for (std::size_t v = 0; v < points_.size(); ++v) points_[v] = {mesh_.vertices_m[v], normals_[v]};
    first_on_edge_.assign(adjacency_.edge_vertices.size(), kNone);
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
      if (relief_of(t) != nullptr) cut(t);
    }
    // Now that the edges are cut: the others follow them.
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
      if (relief_of(t) == nullptr) follow(t);
    }
    MeshFile out;
    for (const Point& point : points_) {
      const double height_m = point.heights > 0 ? point.height_m / point.heights : 0.0;
      out.vertices.push_back((point.p_m + height_m * point.normal) / object_.unit_m);
    }
    out.triangles = std::move(triangles_);
    return out;
  }

 private:
  void find_reliefs() {
    for (const SceneTexture& texture : object_.textures) {
      if (!is_height_field(texture.texture.model)) continue;
      const double offset_m =
          texture.texture.height_offset_m ? *texture.texture.height_offset_m : height_offset_m(texture.texture.model);
      reliefs_[texture.index] = {&texture.texture, offset_m};
    }
    at_border_.assign(mesh_.vertices_m.size(), false);
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
      if (relief_of(t) != nullptr) continue;
      for (const std::uint32_t v : mesh_.triangles[t]) at_border_[v] = true;
    }
  }

  const Relief* relief_of(std::uint32_t t) const {
    if (t >= object_.mesh.haptic.size() || adjacency_.edge_of_triangle[t][0] == kNone) return nullptr;
    const auto found = reliefs_.find(object_.mesh.haptic[t].texture);
    return found == reliefs_.end() ? nullptr : &found->second;
  }

  void choose_cuts() {
    double longest_m = 0.0;
    std::size_t textured = 0;
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
      if (relief_of(t) == nullptr) continue;
      ++textured;
      for (std::size_t e = 0; e < 3; ++e) {
        const Triangle& tri = mesh_.triangles[t];
        longest_m = std::max(longest_m, (mesh_.vertices_m[tri[(e + 1) % 3]] - mesh_.vertices_m[tri[e]]).norm());
      }
    }
    const double cuts = std::max(1.0, std::ceil(longest_m / (1e-3 * config_.spacing_mm)));
    if (!(cuts * cuts * static_cast<double>(textured) <= static_cast<double>(kMostTriangles))) too_fine();
    cuts_ = static_cast<std::uint32_t>(cuts);
  }

  [[noreturn]] void too_fine() const {
    throw Error("displaced mesh: " + number_text(config_.spacing_mm) + " mm would make more than " +
                std::to_string(kMostTriangles) + " triangles; a larger spacing_mm is needed");
  }

  // The point `k` of `cuts_` along a triangle's edge e, counted from its corner e.
  std::uint32_t on_edge(std::uint32_t t, std::size_t e, std::uint32_t k) {
    const Triangle& tri = mesh_.triangles[t];
    if (k == 0) return tri[e];
    if (k == cuts_) return tri[(e + 1) % 3];
    const std::uint32_t edge = adjacency_.edge_of_triangle[t][e];
    const auto [low, high] = adjacency_.edge_vertices[edge];
    if (first_on_edge_[edge] == kNone) {
      first_on_edge_[edge] = static_cast<std::uint32_t>(points_.size());
      for (std::uint32_t i = 1; i < cuts_; ++i) {
        const double u = static_cast<double>(i) / cuts_;
        points_.push_back({(1.0 - u) * mesh_.vertices_m[low] + u * mesh_.vertices_m[high],
                           unit((1.0 - u) * normals_[low] + u * normals_[high])});
      }
    }
    return first_on_edge_[edge] + (tri[e] == low ? k : cuts_ - k) - 1;
  }

  static Vector3d unit(const Vector3d& n) { return n.isZero(0.0) ? n : Vector3d(n.normalized()); }

  void cut(std::uint32_t t) {
    const Triangle& tri = mesh_.triangles[t];
    std::vector<std::uint32_t> grid;  // row i from corner 0 towards 1, column j towards 2
    std::vector<std::size_t> row_begin;
    for (std::uint32_t i = 0; i <= cuts_; ++i) {
      row_begin.push_back(grid.size());
      for (std::uint32_t j = 0; i + j <= cuts_; ++j) {
        const Vector3d w(static_cast<double>(cuts_ - i - j) / cuts_, static_cast<double>(i) / cuts_,
                         static_cast<double>(j) / cuts_);
        std::uint32_t point;
        if (j == 0) {
          point = on_edge(t, 0, i);
        } else if (i + j == cuts_) {
          point = on_edge(t, 1, j);
        } else if (i == 0) {
          point = on_edge(t, 2, cuts_ - j);
        } else {
          point = static_cast<std::uint32_t>(points_.size());
          Point inner;
          inner.p_m =
              w[0] * mesh_.vertices_m[tri[0]] + w[1] * mesh_.vertices_m[tri[1]] + w[2] * mesh_.vertices_m[tri[2]];
          inner.normal = unit(w[0] * normals_[tri[0]] + w[1] * normals_[tri[1]] + w[2] * normals_[tri[2]]);
          points_.push_back(inner);
        }
        points_[point].height_m += height_m(t, w);
        ++points_[point].heights;
        grid.push_back(point);
      }
    }
    const auto at = [&](std::uint32_t i, std::uint32_t j) { return grid[row_begin[i] + j]; };
    for (std::uint32_t i = 0; i < cuts_; ++i) {
      for (std::uint32_t j = 0; i + j < cuts_; ++j) {
        triangles_.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
        if (i + j + 1 < cuts_) triangles_.push_back({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
      }
    }
  }

  double height_m(std::uint32_t t, const Vector3d& w) const {
    const Relief& relief = *relief_of(t);
    double border = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      if (at_border_[mesh_.triangles[t][k]]) border += w[static_cast<Eigen::Index>(k)];
    }
    const double fade = smoothstep(1.0 - border);
    const auto& xy_mm = object_.mesh.haptic[t].xy_mm;
    const Vector2d xy_m = 1e-3 * (w[0] * xy_mm[0] + w[1] * xy_mm[1] + w[2] * xy_mm[2]);
    return config_.gain * fade *
           (evaluate_height(relief.texture->model, xy_m.x(), xy_m.y()).height_m + relief.height_offset_m);
  }

  // A triangle without texture, its edges cut where its neighbours' are.
  void follow(std::uint32_t t) {
    const Triangle& tri = mesh_.triangles[t];
    if (adjacency_.edge_of_triangle[t][0] == kNone) return;
    std::vector<std::uint32_t> rim;
    for (std::size_t e = 0; e < 3; ++e) {
      rim.push_back(tri[e]);
      if (first_on_edge_[adjacency_.edge_of_triangle[t][e]] == kNone) continue;
      for (std::uint32_t k = 1; k < cuts_; ++k) rim.push_back(on_edge(t, e, k));
    }
    if (rim.size() == 3) {
      triangles_.push_back(tri);
      return;
    }
    if (triangles_.size() + rim.size() > kMostTriangles) too_fine();
    const auto middle = static_cast<std::uint32_t>(points_.size());
    points_.push_back(
        {(mesh_.vertices_m[tri[0]] + mesh_.vertices_m[tri[1]] + mesh_.vertices_m[tri[2]]) / 3.0, Vector3d::Zero()});
    for (std::size_t i = 0; i < rim.size(); ++i) triangles_.push_back({rim[i], rim[(i + 1) % rim.size()], middle});
  }

  const SceneObject& object_;
  const DisplaceMeshConfig& config_;
  TriangleMesh mesh_;
  MeshAdjacency adjacency_;
  std::vector<Vector3d> normals_;
  std::map<int, Relief> reliefs_;
  std::vector<bool> at_border_;
  std::uint32_t cuts_ = 1;
  std::vector<Point> points_;
  std::vector<std::uint32_t> first_on_edge_;
  std::vector<Triangle> triangles_;
};

}  // namespace

MeshFile displace_mesh(const SceneObject& object, const DisplaceMeshConfig& config) {
  if (!(config.spacing_mm > 0.0) || !(object.unit_m > 0.0))
    throw Error("displaced mesh: a spacing of " + number_text(config.spacing_mm) + " mm");
  return Displacer(object, config).run();
}

}  // namespace asperity
