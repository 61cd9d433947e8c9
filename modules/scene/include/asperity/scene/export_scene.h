#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "asperity/base/problem.h"
#include "asperity/scene/displace_mesh.h"
#include "asperity/scene/scene.h"
#include "asperity/scene/texture_maps.h"
#include "asperity/texture/synthesize_stroke.h"

namespace asperity {

enum class ExportFormat { kObj, kGltf, kPng, kWav, kX3p, kStl };
inline constexpr std::array<std::string_view, 6> kExportFormatNames{"obj", "gltf", "png", "wav", "x3p", "stl"};

struct ExportConfig {
  TextureMapsConfig images;
  StrokeConfig stroke;
  DisplaceMeshConfig relief;

  template <class V>
  void visit(V& v) {
    v.group("images", images);
    v.group("stroke", stroke);
    v.group("relief", relief);
  }
};

struct ExportedFile {
  std::string name;
  std::string content;
};

struct ExportResult {
  std::vector<ExportedFile> files;
  Problems problems;  // "not_exported": a texture that the format has no form for
};

// A scene in the files of other programs:
//   obj   each mesh as Wavefront OBJ with its haptic coordinates, and its materials
//   gltf  each mesh with its textures as normal and height maps, one .glb
//   png   each texture's heights and normals, 16 bits, and a JSON file of their size and range
//   wav   the acceleration of a tool that strokes each texture, 90 % of full scale at its highest; a JSON file says
//   what
//         full scale is
//   x3p   each texture's heights (ISO 25178-72); of a texture along a line, its profile
//   stl   each mesh with its textures as relief, for printing (displace_mesh.h), in millimetres
// Files are named after the meshes and textures. Throws Error if nothing is left to export.
ExportResult export_scene(const Scene& scene, ExportFormat format, const ExportConfig& config = {});

}  // namespace asperity
