#pragma once

#include <cmath>

#include <Eigen/Core>

#include "asperity/geometry/nearest_on_triangle.h"
#include "asperity/render/near_triangles.h"

namespace asperity {

// The point of a triangle that is nearest to p.
struct TriangleFoot {
  Eigen::Vector3d barycentric;
  Eigen::Vector3d from_m;  // from that point to p
  double distance_m;

  bool inside() const { return barycentric.minCoeff() > 0.0; }
};

inline TriangleFoot foot_on(const NearTriangle& t, const Eigen::Vector3d& p_m) noexcept {
  struct Render;
  const auto near = bvh::nearest_on_triangle<Render>(t.a_m.data(), t.b_m.data(), t.c_m.data(), p_m.data());
  TriangleFoot foot;
  foot.barycentric = Eigen::Vector3d(near.weight[0], near.weight[1], near.weight[2]);
  foot.from_m = near.weight[0] * (p_m - t.a_m) + near.weight[1] * (p_m - t.b_m) + near.weight[2] * (p_m - t.c_m);
  foot.distance_m = std::sqrt(near.distance2);
  return foot;
}

}  // namespace asperity
