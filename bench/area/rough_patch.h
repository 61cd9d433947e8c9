#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "asperity/geometry/mesh_surface.h"
#include "asperity/geometry/triangle_mesh.h"

namespace bench {

// 0.25 to 1 cycles/mm in all directions, `rms_m` high, over the mesh's x and y.
class Relief {
 public:
  Relief(std::uint64_t seed, double rms_m);
  double at(double x_m, double y_m) const;

 private:
  std::vector<Eigen::Vector3d> waves_;
  double height_m_ = 0.0;
};

// The pebble's top as a grid of 0.1 mm with the relief along its normals.
asperity::TriangleMesh rough_top(const asperity::MeshSurface& pebble, const Relief& relief, double half_m);

// The relief as a ball rolls over it: its dilation on a grid of 0.05 mm, taken at the nearest point.
class UnderTip {
 public:
  UnderTip(const Relief& relief, double radius_m, double half_m);
  double at(double x_m, double y_m) const;

 private:
  static constexpr double kSpacing_m = 0.05e-3;
  std::size_t place(int r, int c) const { return static_cast<std::size_t>(r * n_ + c); }
  double half_m_;
  int n_ = 0;
  std::vector<double> height_m_;
};

}  // namespace bench
