#pragma once

#include <string>

#include "asperity/scene/export_scene.h"

namespace asperity {

// One object as binary glTF; textures without heights are named in `problems`.
std::string object_as_glb(const Scene& scene, const SceneObject& object, const TextureMapsConfig& images,
                          Problems& problems);

}  // namespace asperity
