#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "asperity/geometry/surface_patch.h"

namespace asperity {

struct FlattenConfig {
  int iterations = 200;
  double tolerance = 1e-9;

  template <class V>
  void visit(V& v) {
    v.field("iterations", iterations, "most Newton steps of the parametrisation", {1, 100000});
    v.field("tolerance", tolerance, "the steps end where the next one would lower the energy by less than this part",
            {0.0, 1.0});
  }
};

// A patch in the plane.
struct FlatPatch {
  std::vector<Eigen::Vector2d> uv_m;  // [patch vertex], metres of the surface; the patch as seen from outside
  double energy = 0.0;  // mean over the area of ½ (σ₁² + σ₂² + σ₁⁻² + σ₂⁻²); 2 for an isometry
  double stretch_min = 1.0;  // singular values of the triangles' maps from the surface
  double stretch_max = 1.0;
  double stretch_rms = 0.0;      // from 1, by area
  std::size_t flipped = 0;       // inverted triangles: 0
  std::size_t without_area = 0;  // triangles of the mesh without area, which no map can keep
  int iterations = 0;
  bool converged = false;
};

// The plane map of least distortion: it minimises the symmetric Dirichlet energy (Smith and Schaefer 2015), which is
// infinite for a triangle without area, so that none is inverted, and least where lengths are kept. It begins at
// Tutte's embedding on a circle (Tutte 1963), which has no inverted triangle, and continues by Newton's method on the
// energy's Hessian with each triangle's made positive semidefinite by its closed eigensystem (Smith, de Goes and Kim
// 2019), with a line search that stops before a triangle is inverted. docs/geometry.md has the mathematics. Throws
// Error if the equations cannot be solved: triangles many orders of magnitude smaller than others.
FlatPatch flatten_patch(const SurfacePatch& patch, const FlattenConfig& config = {});

}  // namespace asperity
