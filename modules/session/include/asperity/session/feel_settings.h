#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "asperity/base/config.h"
#include "asperity/device/device_caps.h"
#include "asperity/device/device_registry.h"
#include "asperity/device/hand_model_config.h"
#include "asperity/device/servo_loop.h"
#include "asperity/fidelity/score_rendering.h"
#include "asperity/fidelity/surface_stroke.h"
#include "asperity/pipeline/process_config.h"
#include "asperity/render/render_model.h"
#include "asperity/render/texture_model_choice.h"

namespace asperity {

// The settings of `feel`.
struct FeelSettings {
  RenderConfig render;
  TextureModelChoice texture_model = TextureModelChoice::kAuto;
  std::int64_t texture_seed = 1;
  ServoConfig servo;
  SurfaceStrokeConfig stroke;
  HandModelConfig hand;
  DeviceConfigs devices;
  DeviceCapsConfig caps;
  ScoreConfig score;
  ProcessConfig process;

  FeelSettings() { servo.paced = false; }

  // What the renderer is to do, with the texture's model and seed as they were chosen.
  RenderConfig render_config() const {
    RenderConfig out = render;
    out.texture.seed = static_cast<std::uint64_t>(texture_seed);
    out.texture.rate_Hz = servo.rate_Hz;
    if (texture_model != TextureModelChoice::kAuto) {
      out.texture.model = texture_force_model_of(kTextureModelChoices.at(static_cast<std::size_t>(texture_model)));
    }
    return out;
  }

  template <class V>
  void visit(V& v) {
    v.field("render.tip_radius_m", render.tip_radius_m, "radius of the tip, m; 0: a point", {0.0, 0.1});
    v.field("render.stiffness_N_per_m", render.stiffness_N_per_m, "where the scene knows none, N/m", {1.0, 1e6});
    v.field("render.friction", render.friction, "coefficient of sliding where the scene knows none", {0.0, 10.0});
    v.field("render.static_friction_ratio", render.static_friction_ratio,
            "coefficient of sticking over that of sliding", {1.0, 10.0});
    v.field("render.force_shading", render.force_shading, "forces along interpolated normals");
    v.field("render.border_fade_m", render.border_fade_m, "over which a texture fades at its border, m", {0.0, 1.0});
    v.choice("render.texture.model", texture_model, kTextureModelChoices, "force model; auto: the texture's own");
    v.field("render.texture.cross_fade_s", render.texture.cross_fade_s, "after a change of texture, s", {0.0, 10.0});
    v.field("render.texture.cutoff_cycles_per_mm", render.texture.cutoff_cycles_per_mm,
            "of the reconstruction filter; 0: none", {0.0, 1e3});
    v.field("render.texture.seed", texture_seed, "of the random models", {0.0, 9e15});
    v.group("servo", servo);
    v.group("stroke", stroke);
    v.group("hand", hand);
    devices.visit(v);
    v.group("caps", caps);
    v.group("score", score);
    v.group("process", process);
  }
};

// All settings; those of the safety layer stand in a group of their own.
inline std::vector<ConfigField> feel_fields(FeelSettings& settings) {
  std::vector<ConfigField> out;
  bool placed = false;
  for (ConfigField& field : list_fields("", settings)) {
    if (!field.path.starts_with("servo.safety.")) {
      out.push_back(std::move(field));
      continue;
    }
    if (placed) continue;
    for (ConfigField& own : list_fields("safety", settings.servo.safety)) out.push_back(std::move(own));
    placed = true;
  }
  return out;
}

}  // namespace asperity
