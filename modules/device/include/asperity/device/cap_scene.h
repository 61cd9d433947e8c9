#pragma once

#include <string>
#include <vector>

#include "asperity/device/device_caps.h"
#include "asperity/render/render_model.h"
#include "asperity/scene/scene.h"

namespace asperity {

// What can be rendered of a scene on a device, and what had to give, in words.
struct CappedScene {
  Scene scene;
  RenderConfig config;
  std::vector<std::string> warnings;  // a sentence for each cap that changed something; empty if none did
};

// Brings a scene and its render config within `caps`, before make_render_model():
//   every stiffness k_s (scene, textures, material maps, config) to at most the stiffness cap;
//   every compliance k_c so that the texture's spring k_c k_s (thesis §6.5 (5)) is within the texture cap, and that the
//   whole height H of a texture gives k_c k_s H within the force cap;
//   the reconstruction cut-off of textures to the bandwidth cap, if one of them may reach beyond it.
// k_s is here the largest stiffness of the object, wherever it is stated. Throws Error for a texture that cannot be
// rendered with this config.
CappedScene cap_scene(Scene scene, RenderConfig config, const DeviceCaps& caps);

}  // namespace asperity
