#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "asperity/geometry/mesh_adjacency.h"
#include "asperity/geometry/mesh_path.h"
#include "asperity/geometry/mesh_point.h"
#include "asperity/geometry/triangle_mesh.h"

namespace asperity {

// A straight piece of a path inside one triangle: its ends' weights and path lengths.
struct PathPiece {
  std::uint32_t triangle = 0;
  Eigen::Vector3d from = Eigen::Vector3d::Zero();
  Eigen::Vector3d to = Eigen::Vector3d::Zero();
  double from_s_m = 0.0;
  double to_s_m = 0.0;
};

// A path that lies on the surface throughout, piece by piece.
struct SurfacePath {
  std::vector<PathPiece> pieces;
  std::vector<MeshPoint> points;  // the points it was made from, before smoothing
  double length_m = 0.0;          // over the surface
  std::size_t jumps = 0;          // points further from the last than their s_m and the mesh's edges allow
};

// Joins the points of a path over the surface, smoothed by a quadratic in s_m through the points within
// `half_window_m` of each place (nearer ones count more); 0: as they are. The smoothing is done in the plane
// into which the triangles along the path unfold, so that it follows the surface round its edges.
// `edge_m` is the length of the mesh's edges, which sets the spacing.
SurfacePath make_surface_path(const TriangleMesh& mesh, const MeshAdjacency& adjacency, const MeshPath& path,
                              double half_window_m, double edge_m);

// Pieces that continue a path straight on from its end (or, `backwards`, from its start), in the order of s.
std::vector<PathPiece> extend_path(const TriangleMesh& mesh, const MeshAdjacency& adjacency, const SurfacePath& path,
                                   bool backwards, double by_m);

}  // namespace asperity
