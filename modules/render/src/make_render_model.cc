#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <string>
#include <tuple>
#include <utility>

#include "asperity/base/error.h"
#include "asperity/base/nan.h"
#include "asperity/base/text.h"
#include "asperity/geometry/corner_normals.h"
#include "asperity/geometry/mesh_adjacency.h"
#include "asperity/geometry/mesh_normals.h"
#include "asperity/render/proxy_state.h"
#include "asperity/render/render_model.h"
#include "material_id.h"
#include "move_proxy.h"
#include "texture_border.h"

namespace asperity {
namespace {

using Eigen::Vector3d;

void require_value(bool good, const char* what, double value) {
  if (!good) throw Error(std::string("rendering: ") + what + ": " + number_text(value));
}

void check_render_config(const RenderConfig& config) {
  const auto finite = [](double x) { return std::isfinite(x); };
  require_value(finite(config.tip_radius_m) && config.tip_radius_m >= 0.0, "tip radius", config.tip_radius_m);
  require_value(finite(config.stiffness_N_per_m) && config.stiffness_N_per_m > 0.0, "stiffness",
                config.stiffness_N_per_m);
  require_value(finite(config.friction) && config.friction >= 0.0, "friction", config.friction);
  require_value(finite(config.static_friction_ratio) && config.static_friction_ratio >= 1.0,
                "static over sliding friction below 1", config.static_friction_ratio);
  require_value(finite(config.border_fade_m) && config.border_fade_m >= 0.0, "fade at the border",
                config.border_fade_m);
}

// What files hold was checked when they were read; a program may have set anything.
void check_material(const RenderMaterial& material) {
  const auto finite = [](double x) { return std::isfinite(x); };
  require_value(finite(material.stiffness_N_per_m) && material.stiffness_N_per_m >= 0.0,
                "a material's stiffness is below 0", material.stiffness_N_per_m);
  require_value(finite(material.compliance_kc) && material.compliance_kc >= 0.0, "a material's compliance is below 0",
                material.compliance_kc);
  require_value(finite(material.friction) && material.friction >= 0.0, "a material's friction is below 0",
                material.friction);
  require_value(finite(material.static_friction_ratio) && material.static_friction_ratio >= 1.0,
                "a material's static over sliding friction is below 1", material.static_friction_ratio);
}

bool is_closed(const TriangleMesh& mesh) {
  const MeshAdjacency adjacency = make_adjacency(weld_vertices(mesh));
  for (std::size_t e = 0; e < adjacency.edge_vertices.size(); ++e)
    if (adjacency.triangles_of_edge(static_cast<std::uint32_t>(e)).size() != 2) return false;
  return !adjacency.edge_vertices.empty();
}

std::uint64_t hash_of(const TriangleMesh& mesh) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  const auto add = [&](std::uint64_t word) {
    hash = (hash ^ word) * 0x9e3779b97f4a7c15u;
    hash ^= hash >> 29;
  };
  for (const Vector3d& v : mesh.vertices_m)
    for (int k = 0; k < 3; ++k) add(std::bit_cast<std::uint64_t>(v[k]));
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t) add(v);
  return hash;
}

// A length of the object for tolerances; a distance from the origin counts where it would make rounding coarser.
double extent_of(const TriangleMesh& mesh) {
  Vector3d low = mesh.vertices_m[mesh.triangles[0][0]], high = low;
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t v : t) {
      low = low.cwiseMin(mesh.vertices_m[v]);
      high = high.cwiseMax(mesh.vertices_m[v]);
    }
  }
  const double farthest = std::max(low.cwiseAbs().maxCoeff(), high.cwiseAbs().maxCoeff());
  return std::max((high - low).maxCoeff(), 0x1p-12 * farthest);
}

// A vertex so far away that the skin, which follows the extent, would hide the triangles of the rest: throws Error.
void check_extent(const TriangleMesh& mesh) {
  std::vector<double> edges_m, places_m[3];
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      edges_m.push_back((mesh.vertices_m[t[(k + 1) % 3]] - mesh.vertices_m[t[k]]).stableNorm());
      for (int axis = 0; axis < 3; ++axis) places_m[axis].push_back(mesh.vertices_m[t[k]][axis]);
    }
  }
  const auto median = [](std::vector<double>& values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
  };
  const double edge_m = median(edges_m);
  if (extent_of(mesh) * kSkin <= 0x1p-8 * edge_m) return;
  const Vector3d centre_m(median(places_m[0]), median(places_m[1]), median(places_m[2]));
  std::uint32_t farthest = mesh.triangles[0][0];
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t)
      if ((mesh.vertices_m[v] - centre_m).stableNorm() > (mesh.vertices_m[farthest] - centre_m).stableNorm())
        farthest = v;
  const Vector3d& p_m = mesh.vertices_m[farthest];
  throw Error("vertex " + std::to_string(farthest) + " at " + number_text(p_m.x()) + ", " + number_text(p_m.y()) +
              ", " + number_text(p_m.z()) + " m is too far away for a mesh whose edges are " + number_text(edge_m) +
              " m long");
}

double first_known(const std::optional<double>& a, const std::optional<double>& b, double otherwise) {
  return a ? *a : b.value_or(otherwise);
}

// What material_at.h says of the three corners, and the config's where nobody knows. A vertex for which the map has no
// value has one for all its triangles, so that nothing steps at their edges: the mean of the values of the vertices
// that share a triangle with it, if one of these has any.
class Materials {
 public:
  Materials(const Scene& scene, const SceneObject& object, const RenderConfig& config, RenderObject& out)
      : object_(object), map_(object.material.vertices), out_(out) {
    const Texture bare;
    without_ = defaults(scene, bare, config);
    for (const SceneTexture& texture : object.textures)
      with_.emplace(texture.index, defaults(scene, texture.texture, config));
  }

  void run() {
    const auto& triangles = object_.mesh.triangles;
    for (double Material::*const property : kProperties) fill(property);
    std::vector<std::array<std::uint32_t, 3>> corners(triangles.size());
    for (std::size_t t = 0; t < triangles.size(); ++t) corners[t] = corners_of(t, base_of(t));
    if (out_.border.edges) {
      auto bare = corners;
      for (std::size_t t = 0; t < triangles.size(); ++t)
        if (out_.texture[t] >= 0) bare[t] = corners_of(t, without_);
      if (bare != corners) out_.bare_material = std::move(bare);
    }
    if (out_.materials.size() > 1) out_.corner_material = std::move(corners);
  }

 private:
  std::array<std::uint32_t, 3> corners_of(std::size_t t, const RenderMaterial& base) {
    std::array<std::uint32_t, 3> out;
    for (std::size_t k = 0; k < 3; ++k)
      out[k] = index_of({value(t, k, &Material::stiffness_N_per_m, base.stiffness_N_per_m),
                         value(t, k, &Material::compliance_kc, base.compliance_kc),
                         value(t, k, &Material::friction, base.friction),
                         value(t, k, &Material::static_friction_ratio, base.static_friction_ratio)});
    return out;
  }

  static RenderMaterial defaults(const Scene& scene, const Texture& texture, const RenderConfig& config) {
    return {first_known(texture.stiffness_N_per_m, scene.stiffness_N_per_m, config.stiffness_N_per_m),
            texture.compliance_kc.value_or(1.0), first_known(texture.friction, scene.friction, config.friction),
            first_known(texture.static_friction_ratio, scene.static_friction_ratio, config.static_friction_ratio)};
  }

  const RenderMaterial& base_of(std::size_t t) const {
    if (object_.mesh.haptic.empty()) return without_;
    const auto found = with_.find(object_.mesh.haptic[t].texture);
    return found == with_.end() ? without_ : found->second;
  }

  double value(std::size_t t, std::size_t corner, double Material::*property, double otherwise) const {
    if (map_.empty()) return otherwise;
    const double known = map_[object_.mesh.triangles[t][corner]].*property;
    return std::isfinite(known) ? known : otherwise;
  }

  void fill(double Material::*property) {
    const auto known = [&](std::uint32_t v) { return std::isfinite(object_.material.vertices[v].*property); };
    std::vector<double> sum(map_.size(), 0.0), count(map_.size(), 0.0);
    for (const Triangle& corners : object_.mesh.triangles) {
      for (const std::uint32_t v : corners) {
        if (map_.empty() || known(v)) continue;
        for (const std::uint32_t other : corners)
          if (known(other)) sum[v] += object_.material.vertices[other].*property, count[v] += 1.0;
      }
    }
    for (std::size_t v = 0; v < map_.size(); ++v)
      if (count[v] > 0.0) map_[v].*property = sum[v] / count[v];
  }

  std::uint32_t index_of(const RenderMaterial& material) {
    check_material(material);
    const auto key = std::tuple(material.stiffness_N_per_m, material.compliance_kc, material.friction,
                                material.static_friction_ratio);
    const auto [place, is_new] = indices_.try_emplace(key, static_cast<std::uint32_t>(out_.materials.size()));
    if (is_new) out_.materials.push_back(material);
    return place->second;
  }

  static constexpr std::array<double Material::*, 4> kProperties{&Material::stiffness_N_per_m, &Material::compliance_kc,
                                                                 &Material::friction, &Material::static_friction_ratio};

  const SceneObject& object_;
  std::vector<Material> map_;  // the scene's, filled
  RenderObject& out_;
  RenderMaterial without_;
  std::map<int, RenderMaterial> with_;
  std::map<std::tuple<double, double, double, double>, std::uint32_t> indices_;
};

// Numbers each triangle's texture among the model's, and takes its coordinates.
void lay_textures(const SceneObject& object, RenderModel& model, const RenderConfig& config, RenderObject& out) {
  if (object.mesh.haptic.empty()) return;
  std::map<int, std::int32_t> place;
  for (const SceneTexture& texture : object.textures) {
    place[texture.index] = static_cast<std::int32_t>(model.textures.size());
    model.textures.push_back(make_render_texture(texture.texture, config.texture));
  }
  const std::size_t count = object.mesh.triangles.size();
  out.texture.assign(count, -1);
  out.texture_xy_m.resize(count);
  bool any = false;
  for (std::size_t t = 0; t < count; ++t) {
    const HapticTriangle& haptic = object.mesh.haptic[t];
    const auto found = place.find(haptic.texture);
    if (found == place.end()) continue;
    out.texture[t] = found->second;
    any = true;
    for (std::size_t k = 0; k < 3; ++k) out.texture_xy_m[t][k] = 1e-3 * haptic.xy_mm[k];
  }
  if (any) return;
  out.texture.clear();
  out.texture_xy_m.clear();
}

RenderObject make_object(const Scene& scene, const SceneObject& object, const RenderConfig& config, RenderModel& model,
                         const Observer& observer) {
  observer.update("scene", 0.0);
  if (!object.mesh.haptic.empty() && object.mesh.haptic.size() != object.mesh.triangles.size())
    throw Error(std::to_string(object.mesh.haptic.size()) + " haptic triangles for " +
                std::to_string(object.mesh.triangles.size()));
  if (!object.material.vertices.empty() && object.material.vertices.size() != object.mesh.vertices.size())
    throw Error(std::to_string(object.material.vertices.size()) + " materials for " +
                std::to_string(object.mesh.vertices.size()) + " vertices");
  require_value(std::isfinite(object.unit_m) && object.unit_m > 0.0, "unit in metres", object.unit_m);
  if (!object.T_world_mesh.rotation.coeffs().allFinite() || !object.T_world_mesh.translation_m.allFinite())
    throw Error("its pose is not finite");
  TriangleMesh mesh = to_metres(object.mesh, object.unit_m);
  MeshBvh bvh(mesh, observer);  // throws for indices and numbers that are no use
  observer.update("scene", 0.3);
  check_extent(mesh);
  RenderObject out{.mesh = std::move(mesh),
                   .bvh = std::move(bvh),
                   .normals = {},
                   .closed = false,
                   .T_world_mesh = {object.T_world_mesh.rotation.normalized(), object.T_world_mesh.translation_m},
                   .id = 0,
                   .texture = {},
                   .texture_xy_m = {},
                   .border = {},
                   .corner_normals = {},
                   .materials = {},
                   .corner_material = {},
                   .bare_material = {}};
  out.normals = facet_normals(out.mesh);
  observer.update("scene", 0.5);
  out.closed = is_closed(out.mesh);
  observer.update("scene", 0.7);
  out.id = hash_of(out.mesh);
  lay_textures(object, model, config, out);
  observer.update("scene", 0.8);
  out.border = make_texture_border(out, model.textures, config.border_fade_m);
  observer.update("scene", 0.9);
  if (config.force_shading) {
    const TriangleMesh welded = weld_vertices(out.mesh);
    out.corner_normals = corner_normals(welded, make_adjacency(welded));
  }
  Materials(scene, object, config, out).run();
  return out;
}

}  // namespace

RenderModel make_render_model(const Scene& scene, const RenderConfig& config, const Observer& observer) {
  check_render_config(config);
  if (scene.objects.empty()) throw Error("rendering: a scene without objects");
  if (scene.objects.size() > ProxyState::kMostObjects)
    throw Error("rendering: " + std::to_string(scene.objects.size()) + " objects, at most " +
                std::to_string(ProxyState::kMostObjects));
  RenderModel model;
  model.config = config;
  for (std::size_t k = 0; k < scene.objects.size(); ++k) {
    try {
      model.objects.push_back(make_object(scene, scene.objects[k], config, model, observer));
    } catch (const Cancelled&) {
      throw;
    } catch (const Error& error) {
      throw Error("rendering: object " + std::to_string(k) + " (" + printable(scene.objects[k].mesh_file) +
                  "): " + error.what());
    }
    model.extent_m = std::max(model.extent_m, extent_of(model.objects.back().mesh));
  }
  for (const RenderTexture& texture : model.textures) model.highest_m = std::max(model.highest_m, texture.highest_m);
  if (!(model.extent_m > 0.0)) throw Error("rendering: the objects have no extent");
  model.material_id = material_id(model);
  return model;
}

}  // namespace asperity
