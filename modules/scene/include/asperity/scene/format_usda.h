#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "asperity/geometry/mesh_file.h"

namespace asperity {

// The images of a haptic texture beside a USDA file, and what its material is.
struct UsdaTexture {
  int index = 0;  // of HapticTriangle
  std::string name;
  Eigen::Vector2d size_mm = Eigen::Vector2d::Ones();  // that the images cover
  std::string height_file;                            // grey of black_m to white_m; empty: none
  std::string normal_file;                            // as format_normal_png writes it; empty: none
  double black_m = 0.0;
  double white_m = 0.0;
  std::optional<double> stiffness_N_per_m;
  std::optional<double> friction;
  std::optional<double> static_friction_ratio;
  std::string warning;  // what is wrong with its source; empty: nothing known
};

// A mesh as USDA, the text form of OpenUSD, in metres: one Xform with one Mesh, a GeomSubset and a Material for each
// haptic texture with each of the mesh's materials. Normals, the mesh's own texture coordinates and vertex colours are
// primvars where all triangles have them (primvars:st, v upwards, as OBJ's). A material is a UsdPreviewSurface:
// diffuseColor, and of a haptic texture the normal map and the height map as inputs:displacement, scaled to metres, on
// primvars:haptic (x_mm / size.x, 1 − y_mm / size.y), which repeats. Friction is UsdPhysics'
// (PhysicsMaterialAPI, physics:dynamicFriction, staticFriction); stiffness and the warning are attributes of our own
// (asperity:stiffness_N_per_m, asperity:warning), as USD has none. The same mesh gives the same bytes. Throws Error for
// a mesh without triangles, a number that is not finite, or indices out of range.
std::string format_usda(const std::string& name, const MeshFile& mesh, double unit_m,
                        const std::vector<UsdaTexture>& textures);

}  // namespace asperity
