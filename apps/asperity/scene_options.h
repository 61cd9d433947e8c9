#pragma once

#include <string>

#include "asperity/session/feel_scene.h"

namespace asperity::app {

// What is to be felt, as typed.
struct SceneOptions {
  std::string scene, mesh_unit;
  std::string height_maps;  // a.png,b.png,…
  std::string tile, height_range;
};

// The same in SI units. Throws UsageError for options that do not go together, and for units that are none.
SceneInput scene_input_of(const SceneOptions& options);

}  // namespace asperity::app
