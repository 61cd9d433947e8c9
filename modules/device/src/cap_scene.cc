#include "asperity/device/cap_scene.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "asperity/base/text.h"
#include "asperity/render/render_texture.h"
#include "asperity/texture/evaluate_height.h"

namespace asperity {
namespace {

// The largest value that was lowered, for one sentence about all of them.
struct Lowered {
  double largest = 0.0;

  void to(double limit, double& value) {
    if (!(value > limit)) return;
    largest = std::max(largest, value);
    value = limit;
  }
  void to(double limit, std::optional<double>& value) {
    if (value) to(limit, *value);
  }
};

void cap_stiffness(CappedScene& capped, const DeviceCaps& caps) {
  Lowered lowered;
  // A default that the scene overrides everywhere is lowered too, but not spoken of.
  if (!capped.scene.stiffness_N_per_m) lowered.to(caps.stiffness_N_per_m, capped.config.stiffness_N_per_m);
  capped.config.stiffness_N_per_m = std::min(capped.config.stiffness_N_per_m, caps.stiffness_N_per_m);
  lowered.to(caps.stiffness_N_per_m, capped.scene.stiffness_N_per_m);
  for (SceneObject& object : capped.scene.objects) {
    for (SceneTexture& laid : object.textures) lowered.to(caps.stiffness_N_per_m, laid.texture.stiffness_N_per_m);
    for (Material& vertex : object.material.vertices) lowered.to(caps.stiffness_N_per_m, vertex.stiffness_N_per_m);
  }
  if (lowered.largest > 0.0) {
    capped.warnings.push_back(fmt::format("stiffness lowered from {:.4g} to {:.4g} N/m: {}", lowered.largest,
                                          caps.stiffness_N_per_m, caps.stiffness_reason));
  }
}

double stiffest_N_per_m(const CappedScene& capped, const SceneObject& object) {
  double stiffest = capped.scene.stiffness_N_per_m.value_or(capped.config.stiffness_N_per_m);
  for (const SceneTexture& laid : object.textures) {
    stiffest = std::max(stiffest, laid.texture.stiffness_N_per_m.value_or(0.0));
  }
  for (const Material& vertex : object.material.vertices) {
    if (vertex.stiffness_N_per_m > stiffest) stiffest = vertex.stiffness_N_per_m;
  }
  return stiffest;
}

// Lowers the compliance of a texture and of the map where it is laid; true if it had to.
bool cap_compliance(SceneObject& object, SceneTexture& laid, double limit) {
  Lowered lowered;
  double compliance = laid.texture.compliance_kc.value_or(1.0);
  lowered.to(limit, compliance);
  if (lowered.largest > 0.0) laid.texture.compliance_kc = compliance;
  for (Material& vertex : object.material.vertices) lowered.to(limit, vertex.compliance_kc);
  return lowered.largest > 0.0;
}

void cap_texture_springs(CappedScene& capped, const DeviceCaps& caps) {
  for (SceneObject& object : capped.scene.objects) {
    const double stiffest = stiffest_N_per_m(capped, object);
    for (SceneTexture& laid : object.textures) {
      if (!is_height_field(laid.texture.model)) continue;
      const std::string name = printable(laid.texture.name.empty() ? laid.file : laid.texture.name);
      if (cap_compliance(object, laid, caps.texture_stiffness_N_per_m / stiffest)) {
        capped.warnings.push_back(fmt::format("texture '{}': its spring lowered to {:.4g} N/m: {}", name,
                                              caps.texture_stiffness_N_per_m, caps.texture_stiffness_reason));
      }
      const double highest_m = make_render_texture(laid.texture, capped.config.texture).highest_m;
      if (highest_m > 0.0 && cap_compliance(object, laid, caps.force_N / (stiffest * highest_m))) {
        capped.warnings.push_back(
            fmt::format("texture '{}': its spring lowered to {:.4g} N/m: its height of {:.4g} mm would exceed {:.4g} N",
                        name, caps.force_N / highest_m, 1e3 * highest_m, caps.force_N));
      }
    }
  }
}

void cap_bandwidth(CappedScene& capped, const DeviceCaps& caps) {
  double& cutoff = capped.config.texture.cutoff_cycles_per_mm;
  if (cutoff > 0.0 && cutoff <= caps.texture_cycles_per_mm) return;
  bool beyond = false;
  for (const SceneObject& object : capped.scene.objects) {
    for (const SceneTexture& laid : object.textures) {
      if (!is_height_field(laid.texture.model) || highest_cycles_per_mm(laid.texture) <= caps.texture_cycles_per_mm) {
        continue;
      }
      beyond = true;
      capped.warnings.push_back(fmt::format("texture '{}': may hold {:.4g} cycles/mm, rendered up to {:.4g}: {}",
                                            printable(laid.texture.name.empty() ? laid.file : laid.texture.name),
                                            highest_cycles_per_mm(laid.texture), caps.texture_cycles_per_mm,
                                            caps.texture_bandwidth_reason));
    }
  }
  if (beyond) cutoff = caps.texture_cycles_per_mm;
}

}  // namespace

CappedScene cap_scene(Scene scene, RenderConfig config, const DeviceCaps& caps) {
  CappedScene capped{std::move(scene), config, {}};
  cap_bandwidth(capped, caps);
  cap_stiffness(capped, caps);
  cap_texture_springs(capped, caps);
  return capped;
}

}  // namespace asperity
