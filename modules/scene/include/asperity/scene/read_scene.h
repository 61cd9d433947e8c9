#pragma once

#include <cstdint>
#include <filesystem>

#include "asperity/base/progress.h"
#include "asperity/scene/scene.h"

namespace asperity {

// Reads a *.scene.json of format version 1 with its meshes, textures and material maps, or a mesh file alone (a
// scene of one object without textures, in metres). Throws Error naming file and key for JSON that is broken, a
// key that the format does not have (outside `extra`), a wrong type, a number out of range, a texture index
// given twice or below 0, or a name that leads out of the scene's folder, by a link too; for a mesh or texture
// that cannot be read; and for files that take more than
// `limit_bytes` together, images as they are in memory. Coordinates whose texture the scene does not list are
// a Problem: their triangles are rendered untextured. Throws Cancelled between files and while JSON is read if
// `observer` says so.
Scene read_scene(const std::filesystem::path& path, const Observer& observer = {},
                 std::uint64_t limit_bytes = std::uint64_t{4} << 30);

// True for a name that stays inside the folder in which it stands: relative, without a root, without ".."
// and without backslashes.
bool stays_inside(const std::filesystem::path& name);

}  // namespace asperity
