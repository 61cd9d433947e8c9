#pragma once

#include <vector>

#include <Eigen/Core>

#include "asperity/recording/recording.h"
#include "asperity/simulation/mesh_base.h"
#include "asperity/simulation/scan_path.h"

namespace asperity {

// The path that the hand means to follow, laid on a mesh: points of the mesh, arc length over them.
struct MeshBasePath {
  std::vector<Eigen::Vector3d> p_mesh_m;
  std::vector<double> s_m;       // of the mesh, 0 where the stroke begins
  std::vector<double> path_s_m;  // of ScanPath
  double length_m = 0.0;         // of the stroke
};

// Throws Error where the path leaves the mesh.
MeshBasePath place_on_mesh(const MeshBase& base, const ScanPath& path);

// Puts into `truth` what holds over the mesh itself, from the tip's positions alone: the height h along the
// interpolated normal n of the mesh's point b under the tip, p = b + h n(b) (mesh_surface.h), and the arc length at
// the point of the base path that is nearest to b (erratum 23). On entry `truth.s_m` is ScanPath's.
void measure_on_mesh(const MeshBase& base, const MeshBasePath& path, Truth& truth);

}  // namespace asperity
