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

}  // namespace asperity
