#include "scene_options.h"

#include <string_view>
#include <utility>

#include "command.h"
#include "option_units.h"

namespace asperity::app {

SceneInput scene_input_of(const SceneOptions& options) {
  if (options.scene.empty() == options.height_maps.empty())
    throw UsageError(options.scene.empty() ? "SCENE is missing" : "--height-maps replaces SCENE; give one of the two");
  SceneInput out;
  out.scene = options.scene;
  for (std::string_view rest = options.height_maps; !options.height_maps.empty();) {
    const auto comma = rest.find(',');
    out.height_maps.emplace_back(rest.substr(0, comma));
    if (out.height_maps.back().empty()) throw UsageError("--height-maps: a file's name is empty");
    if (comma == std::string_view::npos) break;
    rest.remove_prefix(comma + 1);
  }
  for (const auto& [option, text] :
       {std::pair{"--tile", &options.tile}, std::pair{"--height-range", &options.height_range}}) {
    if (!text->empty() && out.height_maps.empty()) throw UsageError(std::string(option) + " needs --height-maps");
  }
  if (!options.mesh_unit.empty() && options.scene.empty()) throw UsageError("--mesh-unit needs a mesh");
  if (!options.tile.empty()) out.tile_mm = 1e3 * length_option_m("--tile", options.tile);
  if (!options.height_range.empty()) {
    out.height_range_mm = 1e3 * length_option_m("--height-range", options.height_range);
  }
  if (!options.mesh_unit.empty()) out.mesh_unit_m = unit_option_m("--mesh-unit", options.mesh_unit);
  return out;
}

}  // namespace asperity::app
