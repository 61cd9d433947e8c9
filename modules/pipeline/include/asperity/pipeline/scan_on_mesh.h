#pragma once

#include "asperity/base/config.h"
#include "asperity/geometry/mesh_path.h"
#include "asperity/geometry/mesh_surface.h"
#include "asperity/geometry/pose.h"
#include "asperity/profile/find_base_path.h"

namespace asperity {

struct ScanOnMeshConfig {
  double spacing_m = 0.25e-3;

  template <class V>
  void visit(V& v) {
    v.field("spacing_m", spacing_m, "of the points of a scan's path on the mesh", {1e-6, 0.1});
  }
};

// The path of a scan on its mesh, mesh frame, `spacing_m` apart (seed §5.4): the means of the base points in
// contact over each step of arc length, brought back onto the mesh. s_m is that of the profile, so coordinates
// made from it look the profile up. Empty if nothing is in contact.
MeshPath scan_on_mesh(const BasePathResult& base, const MeshSurface& surface, const Pose& T_mesh_world,
                      const ScanOnMeshConfig& config);

}  // namespace asperity
