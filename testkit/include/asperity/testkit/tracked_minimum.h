#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "asperity/geometry/mesh_adjacency.h"
#include "asperity/geometry/triangle_mesh.h"

namespace asperity::testkit {

// Where a point of a surface is: inside a triangle, on an edge or on a vertex.
struct SurfacePlace {
  enum class Feature { kFace, kEdge, kVertex };
  Feature feature = Feature::kFace;
  std::uint32_t index = 0;     // of the triangle, the edge or the vertex
  std::uint32_t triangle = 0;  // one that the place belongs to
  Eigen::Vector3d p_m = Eigen::Vector3d::Zero();
};

// A local minimum of |x − p| over the points x of a triangle mesh, followed exactly while p moves: what the proxy of a
// point tip without friction has to be.
//
// x is a local minimum if, and only if, in every triangle that x belongs to no point is nearer to p: the distance is
// convex over a triangle, and the triangles of x are all of the surface near it. While one has a nearer point, x goes
// to that triangle's nearest point: a straight descent over the surface. So a minimum that moves is followed from
// triangle to triangle, and one that vanishes is left downhill.
class TrackedMinimum {
 public:
  // Keeps a reference to the mesh. Vertices at the same place must be one (weld_vertices).
  explicit TrackedMinimum(const TriangleMesh& mesh);

  // Begins at the point of `triangle` nearest to p, and descends from there.
  const SurfacePlace& start(std::uint32_t triangle, const Eigen::Vector3d& p_m);

  // p moves along a straight line to p_m, in `steps` steps.
  const SurfacePlace& follow(const Eigen::Vector3d& p_m, int steps = 8);

  const SurfacePlace& place() const { return place_; }
  int descents() const { return descents_; }  // moves from one triangle into another in the last call

 private:
  void descend(const Eigen::Vector3d& p_m);

  const TriangleMesh& mesh_;
  MeshAdjacency adjacency_;
  SurfacePlace place_;
  Eigen::Vector3d last_m_ = Eigen::Vector3d::Zero();
  int descents_ = 0;
};

// The point of a triangle nearest to p, and the corner or edge (of MeshAdjacency) that it lies on.
struct NearestOfTriangle {
  SurfacePlace::Feature feature = SurfacePlace::Feature::kFace;
  int corner_or_edge = 0;
  Eigen::Vector3d p_m = Eigen::Vector3d::Zero();
};
NearestOfTriangle nearest_of_triangle(const Eigen::Vector3d& a_m, const Eigen::Vector3d& b_m,
                                      const Eigen::Vector3d& c_m, const Eigen::Vector3d& p_m);

}  // namespace asperity::testkit
