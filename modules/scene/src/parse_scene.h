#pragma once

#include <string>
#include <string_view>

#include "asperity/base/progress.h"
#include "asperity/scene/scene.h"

namespace asperity {

// The text of a scene.json: names, numbers and poses. Meshes, textures and maps are still empty.
Scene parse_scene(std::string_view text, const std::string& name, const Observer& observer = {});

}  // namespace asperity
