#pragma once

#include <filesystem>
#include <string>

#include "asperity/scene/scene.h"

namespace asperity {

// The text of scene.json alone. The same scene gives the same bytes.
std::string format_scene(const Scene& scene);

// Writes the textures, material maps and meshes (augmented OBJ, seed §6.3; materials beside them) that `scene` names
// into the folder of `path`, and then `path` itself. Throws Error for a name that leads out of the folder or that two
// files share, a mesh file that is not called *.obj, or if a file cannot be written.
void write_scene(const std::filesystem::path& path, const Scene& scene);

}  // namespace asperity
