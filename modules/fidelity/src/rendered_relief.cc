#include "asperity/fidelity/rendered_relief.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/Core>

#include "asperity/base/error.h"
#include "asperity/base/nan.h"
#include "asperity/geometry/mesh_bvh.h"
#include "asperity/scene/material_at.h"
#include "asperity/texture/evaluate_height.h"
#include "asperity/texture/fit_fourier1d_samples.h"

namespace asperity {

namespace {

constexpr double kWholeStroke = 0.5;  // of it a texture has to have without repeating

RenderedRelief named(const Texture& texture, double spacing_m, const RenderConfig& otherwise) {
  RenderedRelief out;
  out.name = texture.name;
  out.spacing_m = spacing_m;
  out.stiffness_known = texture.stiffness_N_per_m.has_value();
  out.friction_known = texture.friction.has_value();
  out.contact.stiffness_N_per_m = texture.stiffness_N_per_m.value_or(otherwise.stiffness_N_per_m);
  out.contact.friction = texture.friction.value_or(otherwise.friction);
  return out;
}

void require_heights(const Texture& texture) {
  if (!is_height_field(texture.model))
    throw Error("the texture '" + texture.name + "' is a force in time: it has no heights to compare");
}

}  // namespace

RenderedRelief relief_of_texture(const Texture& texture, double spacing_m, double stroke_m,
                                 const RenderConfig& otherwise) {
  require_heights(texture);
  RenderedRelief out = named(texture, spacing_m, otherwise);
  const auto window = height_window(texture.model, std::numeric_limits<std::size_t>::max());
  const double length_m = window ? window->length_m : 0.0;
  double whole_m = length_m;
  if (is_synthetic(texture.model)) {
    out.no_places = "the texture is made up from a spectrum";
    whole_m = std::max(length_m, stroke_m);
  } else if (length_m < kWholeStroke * stroke_m) {
    out.no_places = fmt::format("the texture repeats after {:.1f} mm", 1e3 * length_m);
    whole_m = stroke_m + length_m;
  }
  const auto count = static_cast<std::size_t>(std::floor(whole_m / spacing_m)) + 1;
  const double kc = texture.compliance_kc.value_or(1.0);
  for (std::size_t i = 0; i < count; ++i)
    out.height_m.push_back(kc * evaluate_height(texture.model, spacing_m * static_cast<double>(i), 0.0).height_m);
  return out;
}

RenderedRelief relief_of_heights(std::vector<double> height_m, double spacing_m, const Texture& texture,
                                 const RenderConfig& otherwise) {
  RenderedRelief out = named(texture, spacing_m, otherwise);
  while (!height_m.empty() && !std::isfinite(height_m.back())) height_m.pop_back();
  const auto first = std::find_if(height_m.begin(), height_m.end(), [](double h) { return std::isfinite(h); });
  height_m.erase(height_m.begin(), first);
  if (height_m.size() < 64) throw Error("the profile '" + texture.name + "' has fewer than 64 heights");
  const TextureModel series = fit_fourier1d_path(height_m, spacing_m).fit.texture;
  const double kc = texture.compliance_kc.value_or(1.0);
  for (std::size_t i = 0; i < height_m.size(); ++i) {
    const double x_m = spacing_m * static_cast<double>(i);
    out.height_m.push_back(std::isfinite(height_m[i]) ? kc * evaluate_height(series, x_m, 0.0).height_m : kNan);
  }
  return out;
}

RenderedRelief relief_of_scene(const Scene& scene, const ProcessResult& result, const StrokeSignals& stroke,
                               const PathGrid& grid, const RenderConfig& otherwise) {
  if (!scene.T_mesh_world) throw Error("the scene has no registration (T_mesh_world)");
  if (scene.objects.empty()) throw Error("the scene has no object");
  const SceneObject& object = scene.objects.front();
  const TriangleMesh mesh = to_metres(object.mesh, object.unit_m);
  const MeshBvh bvh(mesh);
  RenderedRelief out;
  out.name = object.mesh_file;
  out.spacing_m = grid.spacing_m;
  out.is_laid = true;
  out.stiffness_known = out.friction_known = true;
  std::vector<double> height_m(stroke.size(), kNan);
  double stiffness_sum = 0.0, friction_sum = 0.0, places = 0.0;
  ClosestPoint on;
  for (std::size_t i = 0; i < stroke.size(); ++i) {
    if (stroke.usable[i] == 0) continue;
    const Eigen::Vector3d p_mesh_m = *scene.T_mesh_world * result.base.path.p_world_m[i];
    on = on.found() ? bvh.closest_point(p_mesh_m, on) : bvh.closest_point(p_mesh_m);
    const Material known = material_at(scene, object, on.triangle, on.barycentric);
    out.stiffness_known = out.stiffness_known && std::isfinite(known.stiffness_N_per_m);
    out.friction_known = out.friction_known && std::isfinite(known.friction);
    stiffness_sum += std::isfinite(known.stiffness_N_per_m) ? known.stiffness_N_per_m : otherwise.stiffness_N_per_m;
    friction_sum += std::isfinite(known.friction) ? known.friction : otherwise.friction;
    places += 1.0;
    if (object.mesh.haptic.empty()) continue;
    const HapticTriangle& haptic = object.mesh.haptic[on.triangle];
    const SceneTexture* texture = object.find_texture(haptic.texture);
    if (texture == nullptr) continue;
    require_heights(texture->texture);
    Eigen::Vector2d xy_mm = Eigen::Vector2d::Zero();
    for (std::size_t k = 0; k < 3; ++k)
      xy_mm += on.barycentric[static_cast<Eigen::Index>(k)] * Eigen::Vector2d(haptic.xy_mm[k][0], haptic.xy_mm[k][1]);
    const double kc = std::isfinite(known.compliance_kc) ? known.compliance_kc : 1.0;
    height_m[i] = kc * evaluate_height(texture->texture.model, 1e-3 * xy_mm.x(), 1e-3 * xy_mm.y()).height_m;
    if (is_synthetic(texture->texture.model)) out.no_places = "the texture is made up from a spectrum";
  }
  if (places == 0.0) throw Error("the stroke has no contact in motion over the scene");
  if (std::none_of(height_m.begin(), height_m.end(), [](double h) { return std::isfinite(h); }))
    throw Error("the scene has no texture under the stroke");
  out.contact.stiffness_N_per_m = stiffness_sum / places;
  out.contact.friction = friction_sum / places;
  out.height_m = over_path(stroke, height_m, grid);
  return out;
}

}  // namespace asperity
