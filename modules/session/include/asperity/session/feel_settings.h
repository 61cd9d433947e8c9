#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "asperity/base/config.h"
#include "asperity/device/device_caps.h"
#include "asperity/device/device_registry.h"
#include "asperity/device/hand_model_config.h"
#include "asperity/device/servo_loop.h"
#include "asperity/fidelity/check_renderer.h"
#include "asperity/fidelity/surface_stroke.h"
#include "asperity/pipeline/process_config.h"
#include "asperity/render/render_model.h"

namespace asperity {

// The settings of `feel`.
struct FeelSettings {
  RenderConfig render;
  ServoConfig servo;
  SurfaceStrokeConfig stroke;
  HandModelConfig hand;
  DeviceConfigs devices;
  DeviceCapsConfig caps;
  RendererCheckConfig renderer_check;
  ProcessConfig process;

  FeelSettings() { servo.paced = false; }

  // What the renderer is to do, at the servo's rate.
  RenderConfig render_config() const {
    RenderConfig out = render;
    out.texture.rate_Hz = servo.rate_Hz;
    return out;
  }

  template <class V>
  void visit(V& v) {
    v.group("render", render);
    v.group("servo", servo);
    v.group("stroke", stroke);
    v.group("hand", hand);
    devices.visit(v);
    v.group("caps", caps);
    v.group("renderer_check", renderer_check);
    v.group("process", process);
  }
};

// A setting of the renderer's check by the names that it had before: `score.…`.
inline void add_former_names(ConfigField& field) {
  constexpr std::string_view kNow = "renderer_check.", kBefore = "score.";
  if (!field.path.starts_with(kNow)) return;
  std::vector<std::string> names = field.former;
  names.push_back(field.path);
  for (const std::string& name : names) field.former.push_back(std::string(kBefore) + name.substr(kNow.size()));
}

// All settings; those of the safety layer stand in a group of their own.
inline std::vector<ConfigField> feel_fields(FeelSettings& settings) {
  std::vector<ConfigField> out;
  bool placed = false;
  for (ConfigField& field : list_fields("", settings)) {
    add_former_names(field);
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
