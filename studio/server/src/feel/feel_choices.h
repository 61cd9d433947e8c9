#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "asperity/studio/block.h"

namespace asperity::studio {

// What a user has decided on the Feel page: the document's section "feel". Files are names in the project's folder.
struct FeelChoices {
  std::string scene;                     // scene.json, its folder, or a mesh; empty: none, or the height maps
  std::string mesh_unit;                 // of a mesh given alone: "mm", "0.06m"; empty: the project's
  std::vector<std::string> height_maps;  // images side by side instead of a scene (thesis Fig. 38)
  double tile_mm = 10.0;
  double range_mm = 2.5;
  std::string device = "mouse";
  std::string replay;                           // recording or table that moves the point; empty: none
  bool mapped = false;                          // its table is in the tracker's world
  std::map<std::string, std::string> settings;  // those that differ from the start's, by their path, as in TOML
  std::optional<double> max_force_N;            // lower than the start's
  std::map<int, std::string> textures;          // another texture's file for an index

  bool empty() const { return scene.empty() && height_maps.empty(); }
};

// The section as it begins.
Json first_feel_section();

// Takes the section apart. Throws Error in words naming the key: unknown, of another type, too many or too long.
FeelChoices read_feel_choices(const Json& section);

}  // namespace asperity::studio
