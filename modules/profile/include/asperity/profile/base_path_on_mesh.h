#pragma once

#include <Eigen/Core>

#include "asperity/geometry/mesh_surface.h"
#include "asperity/geometry/motion.h"
#include "asperity/geometry/pose.h"
#include "asperity/profile/find_base_path.h"

namespace asperity {

// The base path of a tip that was registered to a mesh, in the world frame (seed §4.3, §5.4; errata 23 and
// 24): for each sample the point of the mesh under the tip along the mesh's interpolated normal
// (mesh_surface.h), that normal, and the arc length over the mesh.
//
// The mesh itself is the base shape, with `bulge_share` of the curvature that its normals give its facets
// (facet_bulge_m): 0 leaves them flat, 1 rounds them. The arc
// length is measured on the developed path: its steps, rolled into a plane without turning about the normal.
// Outward is the side of the mesh's normals; if the probe was on the other side over most of the path the mesh
// is inside out, the normals are turned and a Problem says so. Without a force sensor, samples further than
// `max_height_m` from the mesh are out of contact.
// Throws Error for fewer than 20 samples, sizes that differ, or numbers that are not finite.
BasePathResult base_path_on_mesh(const TipMotion& motion, const Eigen::Vector3d& tip_in_marker_m,
                                 const MeshSurface& surface, const Pose& T_mesh_world, const BasePathConfig& config,
                                 double bulge_share = 0.0);

}  // namespace asperity
