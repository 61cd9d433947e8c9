#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "asperity/base/problem.h"
#include "asperity/base/progress.h"
#include "asperity/scene/displace_mesh.h"
#include "asperity/scene/scene.h"
#include "asperity/scene/texture_maps.h"
#include "asperity/texture/synthesize_stroke.h"

namespace asperity {

enum class ExportFormat { kObj, kGltf, kUsda, kPng, kWav, kAhap, kHaps, kHjif, kHmpg, kX3p, kStl };
inline constexpr std::array<std::string_view, 11> kExportFormatNames{"obj",  "gltf", "usda", "png", "wav", "ahap",
                                                                     "haps", "hjif", "hmpg", "x3p", "stl"};

// HJIF and HMPG: the steps of a texture's curve, and how deep its line of force over penetration goes.
struct HapticsConfig {
  int spacing_um = 50;
  double penetration_mm = 1.0;

  template <class V>
  void visit(V& v) {
    v.field("spacing_um", spacing_um, "distance of the keyframes of a texture, for hjif and hmpg", {1, 65535});
    v.field("penetration_mm", penetration_mm, "to which the line of stiffness is given, for hjif and hmpg",
            {0.001, 65.0});
  }
};

// AHAP and .haps: windows in which a vibration has one amplitude and frequency.
struct EnvelopeConfig {
  double window_s = 0.02;

  template <class V>
  void visit(V& v) {
    v.field("window_s", window_s, "in which a vibration has one amplitude and frequency, for ahap and haps",
            {0.001, 10.0});
  }
};

struct ExportConfig {
  TextureMapsConfig images;
  StrokeConfig stroke;
  DisplaceMeshConfig relief;
  HapticsConfig haptics;
  EnvelopeConfig vibration;

  template <class V>
  void visit(V& v) {
    v.group("images", images);
    v.group("stroke", stroke);
    v.group("relief", relief);
    v.group("haptics", haptics);
    v.group("vibration", vibration);
  }
};

struct ExportedFile {
  std::string name;
  std::string content;
};

struct ExportResult {
  std::vector<ExportedFile> files;
  Problems problems;  // "not_exported": what the format has no form for; "warning": a texture's source is not valid
};

// A scene in the files of other programs:
//   obj   each mesh as Wavefront OBJ with its haptic coordinates, an MTL of its materials and textures, and their
//   images gltf  each mesh with its textures as normal and height maps, one .glb (write_gltf.h) usda  each mesh as
//   OpenUSD, with displacement, normals and friction (format_usda.h), and the images png   each texture's heights and
//   normals, 16 bits, and a JSON file of their size and range wav   the acceleration of a tool that strokes each
//   texture, 90 % of full scale at its highest; a JSON file says
//         what full scale is
//   ahap  the same as amplitude and frequency for phones (format_ahap.h)
//   haps  the same for Interhaptics (format_haps.h)
//   hjif  each texture's heights along its path, its stiffness and friction (format_hjif.h); of a force in time, the
//         acceleration of one stroke
//   hmpg  the same in its binary form, amplitudes with 8 bits (format_hmpg.h)
//   x3p   each texture's heights (ISO 25178-72); of a texture along a line, its profile
//   stl   each mesh with its textures as relief, for printing (displace_mesh.h), in millimetres
// Files are named after the meshes and textures. A texture's warning is in its file where the format has a place for
// text (not in stl). Throws Error if nothing is left to export.
ExportResult export_scene(const Scene& scene, ExportFormat format, const ExportConfig& config = {},
                          const Observer& observer = {});

}  // namespace asperity
