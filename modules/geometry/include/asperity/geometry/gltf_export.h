#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "asperity/geometry/mesh_file.h"

namespace asperity {

// An image of an export: its PNG bytes, which go into the file, or without them the name of a PNG beside it.
struct GltfImage {
  std::string name;
  std::string png;   // bytes; empty: `file` is referred to
  std::string file;  // relative to the export
};

// A haptic texture of an export: what the triangles with this index are covered with. Haptic coordinates
// become texture coordinates (x_mm / size_mm.x, y_mm / size_mm.y), which repeat; the first row of an
// image is y = 0 and its first column x = 0. A normal map's red and green point along x and against y,
// as glTF takes them.
struct GltfTexture {
  std::int32_t index = 0;  // of HapticTriangle
  std::string name;
  Eigen::Vector2d size_mm = Eigen::Vector2d::Ones();  // that the images cover
  std::optional<GltfImage> normal_map;
  std::optional<GltfImage> height_map;  // grey; black is 0, white height_range_m
  std::optional<double> height_range_m;
  std::optional<double> stiffness_N_per_m;
  std::optional<double> friction;
};

struct GltfExport {
  MeshFile mesh;
  double unit_m = 1.0;  // the length of the mesh's unit; glTF is in metres
  std::vector<GltfTexture> textures;
};

}  // namespace asperity
