#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "asperity/geometry/mesh_bvh.h"
#include "asperity/geometry/triangle_mesh.h"

namespace asperity::testkit {

// The half-space n·x >= b, n a unit vector.
struct HalfSpace {
  Eigen::Vector3d n = Eigen::Vector3d::UnitZ();
  double b_m = 0.0;
};

// The point nearest to p of the intersection of half-spaces, which must not be empty: exact, by adding one after the
// other (Seidel 1991). Boundaries that are parallel to 1e-7 are one.
Eigen::Vector3d nearest_of_half_spaces(const Eigen::Vector3d& p_m, std::span<const HalfSpace> spaces);

// A local minimum of |c − p| over the places c of a ball's centre whose distance to the mesh is at least the radius:
// what the proxy of a sphere tip without friction has to be.
//
// The distance d_T to one triangle T is convex, so it is nowhere below its tangent at c:
//   d_T(x) >= n·(x − q),  q the point of T nearest to c, n = (c − q)/|c − q|.
// {x : n·(x − q) >= radius for all T near c} is therefore a convex part of the free space that contains c. Its point
// nearest to p is the next c: each step stays free of the mesh, none is farther from p than the one before, and where
// c stays, p − c lies in the cone of the −n of the triangles that touch, which is the condition of Karush, Kuhn and
// Tucker. A step is at most a twentieth of the radius, so that few triangles matter.
class BallRest {
 public:
  // Keeps references.
  BallRest(const TriangleMesh& mesh, const MeshBvh& bvh, double radius_m);

  // The minimum to which that descent leads from `centre_m`, which must be free.
  Eigen::Vector3d descend(const Eigen::Vector3d& centre_m, const Eigen::Vector3d& p_m);

  // The same from the last answer, p moving along a straight line in `steps` steps. Begin with start().
  void start(const Eigen::Vector3d& centre_m) { centre_m_ = last_m_ = centre_m; }
  const Eigen::Vector3d& follow(const Eigen::Vector3d& p_m, int steps = 4);

  int iterations() const { return iterations_; }  // of the last descent

 private:
  const TriangleMesh& mesh_;
  const MeshBvh& bvh_;
  double radius_m_;
  Eigen::Vector3d centre_m_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d last_m_ = Eigen::Vector3d::Zero();
  int iterations_ = 0;
  std::vector<std::uint32_t> near_;
  std::vector<HalfSpace> spaces_;
};

// How well a centre fulfils those conditions, by all triangles within its reach.
struct BallConditions {
  double distance_m = 0.0;  // from the mesh
  double residual_m = 0.0;  // of p − c after the best sum Σ λ (−n), λ >= 0, over the features that touch
  std::size_t touching = 0;
};

// Features within radius_m (1 + slack) of the centre touch.
BallConditions ball_conditions(const TriangleMesh& mesh, const MeshBvh& bvh, double radius_m,
                               const Eigen::Vector3d& centre_m, const Eigen::Vector3d& p_m, double slack = 1e-6);

}  // namespace asperity::testkit
