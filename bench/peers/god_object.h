#pragma once

#include <Eigen/Core>

#include "asperity/geometry/mesh_bvh.h"
#include "asperity/geometry/triangle_mesh.h"

namespace bench {

// The proxy of the textbooks (Zilles and Salisbury 1995; Ruspini, Kolarov and Khatib 1997) for a point without
// friction, as it is commonly programmed: a segment is cast from the proxy to the goal; the triangle hit becomes a
// plane, the goal is moved onto that plane, and again, with up to three planes. The proxy keeps an absolute distance
// from what it touches, and planes are parallel below an absolute threshold.
class GodObject {
 public:
  // Keeps references.
  GodObject(const asperity::TriangleMesh& mesh, const asperity::MeshBvh& bvh, double epsilon_m = 1e-5);

  const Eigen::Vector3d& step(const Eigen::Vector3d& device_m);

 private:
  // Moves towards the goal; true if a triangle stopped it, its plane in n and b then.
  bool advance(const Eigen::Vector3d& goal_m, Eigen::Vector3d& n, double& b_m);

  const asperity::TriangleMesh& mesh_;
  const asperity::MeshBvh& bvh_;
  double epsilon_m_;
  bool started_ = false;
  Eigen::Vector3d proxy_m_ = Eigen::Vector3d::Zero();
};

}  // namespace bench
