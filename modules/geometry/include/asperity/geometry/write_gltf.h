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

enum class GltfForm { kJson, kBinary };

// The mesh as glTF 2.0 with everything inside the file (but images given by name). One mesh a haptic
// texture, one primitive a material in it; a vertex for every different corner.
//   POSITION    float32 metres: 24 bits a coordinate, at most 6e-8 of its size. An OBJ keeps doubles.
//   NORMAL      where all triangles of a primitive have them, unit.
//   TEXCOORD_0  the mesh's own texture coordinates (v turned over), else a copy of the haptic ones.
//   TEXCOORD_1  the haptic coordinates divided by the texture's size.
// The material of a haptic primitive has the texture's normal map as normalTexture on TEXCOORD_1. What
// glTF has no place for is in `extras`: of the primitive, "asperity" {haptic_texture, size_mm}, from which
// parse_gltf restores the haptic coordinates; of the material, "asperity" {name, height_map (index of a
// glTF texture), height_range_m, stiffness_N_per_m, friction}; of the file and its meshes,
// "MPEG_material_haptic" in the form of ISO/IEC 23090-14 Amd. 2: `materials` whose vibrotactileTexture
// is the height map, and `hapticMaterialIndex`.
// Vertex colours, groups and smoothing groups are not written.
// Throws Error for a mesh that contradicts itself, a number that is not finite or beyond float32, a
// texture without size, and files of 4 GiB or more.
std::string format_gltf(const GltfExport& scene, GltfForm form);

// format_gltf into a file that is replaced as a whole: binary if `path` ends in .glb, JSON for .gltf.
void write_gltf(const std::filesystem::path& path, const GltfExport& scene);

}  // namespace asperity
