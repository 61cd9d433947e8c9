#include "asperity/scene/set_mesh_unit.h"

#include <fmt/format.h>

namespace asperity {

void set_mesh_unit(Scene& scene, const std::filesystem::path& file, double unit_m) {
  SceneObject& object = scene.objects.front();
  if (file.extension() == ".json" && object.unit_m != unit_m) {
    throw WrongUnit(fmt::format("the scene states {} m", object.unit_m));
  }
  object.unit_m = unit_m;
}

}  // namespace asperity
