#pragma once

#include <cstdint>
#include <filesystem>
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
  std::optional<GltfImage> height_map;  // grey; black is height_low_m, white height_range_m above it
  std::optional<double> height_range_m;
  double height_low_m = 0.0;
  std::optional<double> stiffness_N_per_m;
  std::optional<double> friction;
  std::string warning{};  // what is wrong with its source; empty: nothing known
};

struct GltfExport {
  MeshFile mesh;
  double unit_m = 1.0;  // the length of the mesh's unit; glTF is in metres
  std::vector<GltfTexture> textures;
  std::string white_png{};  // a PNG of one white pixel: the image of a coefficient that is the same everywhere
};

enum class GltfForm { kJson, kBinary };

// The mesh as glTF 2.0 with everything inside the file (but images given by name). One mesh a haptic
// texture, one primitive a material in it; a vertex for every different corner.
//   POSITION    float32 metres: 24 bits a coordinate, at most 6e-8 of its size. An OBJ keeps doubles.
//   NORMAL      where all triangles of a primitive have them, unit.
//   TEXCOORD_0  the mesh's own texture coordinates (v inverted), else a copy of the haptic ones.
//   TEXCOORD_1  the haptic coordinates divided by the texture's size.
// The material of a haptic primitive has the texture's normal map as normalTexture on TEXCOORD_1. What
// glTF has no place for is in `extras`: of the primitive, "asperity" {haptic_texture, size_mm}, from which
// parse_gltf restores the haptic coordinates; of the material, "asperity" {name, height_map (index of a
// glTF texture), height_range_m, height_low_m, stiffness_N_per_m, friction, warning}. The file's extension
// MPEG_haptic_material (KhronosGroup/glTF, extensions/2.0/Vendor) has a material for each haptic texture, to which the
// extension of a mesh points (hapticMaterialIndex): vibrotactileTexture is the height map; stiffness and friction are
// images of one white pixel, if white_png is given. The extension states no scale, so each image has extras.asperity
// {black, white, unit}: the values of black and white.
//   COLOR_0     vertex colours where all vertices of a primitive have one, within 0 and 1, taken as linear.
// Groups and smoothing groups are not written.
// Throws Error for a mesh that contradicts itself, a number that is not finite or beyond float32, a
// texture without size, and files of 4 GiB or more.
std::string format_gltf(const GltfExport& scene, GltfForm form);

// format_gltf into a file that is replaced as a whole: binary if `path` ends in .glb, JSON for .gltf.
void write_gltf(const std::filesystem::path& path, const GltfExport& scene);

}  // namespace asperity
