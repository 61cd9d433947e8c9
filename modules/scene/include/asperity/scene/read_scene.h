#pragma once

#include <filesystem>

#include "asperity/scene/scene.h"

namespace asperity {

// Reads a *.scene.json of format version 1 with its meshes, textures and material maps, or a mesh file alone (a
// scene of one object without textures, in metres). Throws Error naming file and key for JSON that is broken, a
// key that the format does not have (outside `extra`), a wrong type, a number out of range, a texture index
// given twice or below 0, or a name that leads out of the scene's folder; and for a mesh or texture that
// cannot be read. Coordinates whose texture the scene does not list are a Problem: their triangles are felt untextured.
Scene read_scene(const std::filesystem::path& path);

// True for a name that stays inside the folder in which it stands: relative, without a root and without "..".
bool stays_inside(const std::filesystem::path& name);

}  // namespace asperity
