#pragma once

#include <filesystem>

#include "asperity/scene/scene.h"

namespace asperity {

// Gives the textures of a scene that was read from `folder` the verdict of what they were measured by, where that is
// not valid: of the scan in registration.json by the texture's index, else of result.json or area.json as a whole.
// A file that cannot be read is a warning of its own.
void add_source_warnings(const std::filesystem::path& folder, Scene& scene);

}  // namespace asperity
