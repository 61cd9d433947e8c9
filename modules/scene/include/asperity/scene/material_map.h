#pragma once

#include <cstddef>
#include <filesystem>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "asperity/geometry/haptic_triangle.h"
#include "asperity/geometry/triangle_mesh.h"

namespace asperity {

// Compliance and friction at a position. nan: not known there.
struct Material {
  double compliance_kc = std::numeric_limits<double>::quiet_NaN();  // k_c, within 0 and 1 (thesis §5.3)
  double stiffness_N_per_m = std::numeric_limits<double>::quiet_NaN();
  double friction = std::numeric_limits<double>::quiet_NaN();               // coefficient of sliding
  double static_friction_ratio = std::numeric_limits<double>::quiet_NaN();  // coefficient of sticking over it, from 1
};

// Material at each vertex of a mesh; between them it is interpolated over the triangle.
struct MaterialMap {
  std::vector<Material> vertices;  // one a vertex
};

// What was measured in textured areas, spread over them: a vertex has the mean of the materials of the textures
// that meet in it, one for each triangle, and nan where none is known. `materials[k]` is that of the texture
// `textures[k]`. Throws Error if the sizes differ or an index is out of range.
MaterialMap spread_materials(std::size_t vertices, std::span<const Triangle> triangles,
                             std::span<const HapticTriangle> haptic, std::span<const int> textures,
                             std::span<const Material> materials);

// CSV: vertex,compliance_kc,stiffness_N_per_m,friction, and static_friction_ratio where a vertex has one; vertices of
// which nothing is known have no line.
std::string format_material_map(const MaterialMap& map);

// Reads that for a mesh of `vertices` vertices. Throws Error naming file, line and column for a vertex out of
// range or given twice, k_c outside 0 and 1, a stiffness that is not positive, a negative friction or a ratio below 1.
MaterialMap parse_material_map(std::string_view text, const std::string& name, std::size_t vertices);

}  // namespace asperity
