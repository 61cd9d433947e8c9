#pragma once

#include <optional>
#include <string>

#include <Eigen/Core>

namespace asperity {

// What MTL and glTF materials share. File names are relative to the folder of the file that names them
// and stay inside it; empty: none.
struct MeshMaterial {
  std::string name;
  std::optional<Eigen::Vector3d> base_colour;  // r g b, 0 to 1
  std::string base_colour_map;
  std::string normal_map;
  std::string bump_map;
  std::string displacement_map;
};

}  // namespace asperity
