#pragma once

#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "asperity/geometry/mesh_surface.h"

namespace asperity {

// A line over a mesh for the hand to follow, mesh frame: points `spacing_m` apart on or, where it crosses an edge
// between two of them, within a few micrometres of the mesh.
struct MeshStroke {
  std::vector<Eigen::Vector3d> p_mesh_m;
  double spacing_m = 0.0;
  double length_m = 0.0;  // from the first picked point to the last
  double margin_m = 0.0;  // by which the line begins before the one and ends after the other
};

// The points that "x,y,z;x,y,z;…" spells, m. Throws Error naming `what` for anything else, for a number beyond
// 1000 m and for more than 1000 points.
std::vector<Eigen::Vector3d> parse_points_m(std::string_view text, std::string_view what);

// Joins picked points over the surface: between two of them the chord is halved, its middle moved to the mesh
// and the line pulled tight there (each point to the mesh's nearest to the middle of its neighbours), again and
// again until the points are as near as the spacing: a shortest line, up to the mesh's facets. One point, or none, is
// gone through straight on over `length_m`, half on each side, along the object's longest axis; none stands for
// the point where the object's shortest axis leaves it. (Axes: eigenvectors of the area's second moments.)
// Throws Error for a picked point further from the mesh than a tenth of its size, for neighbouring ones at the
// same place, and where no line over the surface is found.
MeshStroke trace_mesh_stroke(const MeshSurface& surface, const std::vector<Eigen::Vector3d>& picked_m, double length_m);

}  // namespace asperity
