#pragma once

#include <filesystem>

#include "asperity/base/error.h"
#include "asperity/scene/scene.h"

namespace asperity {

// A scene says otherwise what its unit is.
class WrongUnit : public Error {
 public:
  using Error::Error;
};

// Gives the first mesh of what was read from `file` a unit of `unit_m`. Throws WrongUnit for a scene.json that has
// another one.
void set_mesh_unit(Scene& scene, const std::filesystem::path& file, double unit_m);

// The length of the diagonal of the box around a mesh, m.
double size_of_mesh_m(const MeshFile& mesh, double unit_m);

// Throws Error, which says what to state, where nobody stated the unit of a mesh's file and metres make it something
// that no hand scans: larger than 5 m, or smaller than 1 mm. A scene.json and glTF state their unit themselves.
void refuse_unlikely_metres(const MeshFile& mesh, const std::filesystem::path& file);

}  // namespace asperity
