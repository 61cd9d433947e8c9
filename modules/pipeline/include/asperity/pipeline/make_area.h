#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "asperity/base/problem.h"
#include "asperity/base/progress.h"
#include "asperity/geometry/flatten_patch.h"
#include "asperity/geometry/haptic_triangle.h"
#include "asperity/geometry/mesh_path.h"
#include "asperity/geometry/surface_patch.h"
#include "asperity/geometry/triangle_mesh.h"
#include "asperity/profile/profile.h"
#include "asperity/texture/map_strokes.h"
#include "asperity/texture/texture.h"
#include "asperity/verdict/verdict.h"

namespace asperity {

struct AreaConfig {
  SurfacePatchConfig patch;
  FlattenConfig parametrisation;
  MapStrokesConfig map;

  template <class V>
  void visit(V& v) {
    v.group("patch", patch);
    v.group("parametrisation", parametrisation);
    v.group("map", map);
  }
};

// A registered scan: its path on the mesh and the heights over it, by the same arc length.
struct AreaScan {
  std::string name;
  MeshPath path;
  Profile profile;
};

// An areal texture of a mesh.
struct AreaResult {
  std::size_t patch_triangles = 0;
  std::size_t filled = 0;  // of them, reached by no stroke
  double area_m2 = 0.0;    // of the patch
  FlatPatch flat;          // uv_m in the texture's coordinates
  StrokeMap map;
  double covered = 0.0;                     // part of the patch's area that has heights
  std::vector<std::string> apart;           // scans that are not on the patch
  std::optional<Texture> texture;           // none if the verdicts are invalid
  std::vector<std::uint32_t> triangle;      // of the mesh, that have the texture; rising
  std::vector<HapticTriangle> coordinates;  // of them; `texture` is 0
  Problems problems;
  Verdicts verdicts;
  bool trustworthy = true;
  std::string verdict;
  AreaConfig config;
};

// Many scans over a patch of a mesh as one areal texture: the patch (find_surface_patch), its plane (flatten_patch),
// the strokes in it, the map (map_strokes). x is the strokes' common direction, y to its right seen from outside, both
// in millimetres of the surface, 0 at the map's corner. Triangles of which at least half has heights get the texture.
// `registered`: the registration is not invalid. Throws Error as the steps do.
AreaResult make_area(const TriangleMesh& mesh, const std::vector<AreaScan>& scans, bool registered,
                     const AreaConfig& config = {}, const Observer& observer = {});

// area.json: everything measured, the settings, the version. `name` is the texture's file, empty if there is none.
std::string format_area(const AreaResult& result, const std::vector<AreaScan>& scans, const std::string& name);

}  // namespace asperity
