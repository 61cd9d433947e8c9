#pragma once

#include <array>
#include <cstdint>

#include "asperity/base/config.h"
#include "asperity/geometry/triangle_mesh.h"

namespace asperity {

struct PebbleConfig {
  std::int64_t seed = 1;
  std::array<double, 3> semi_axes_m{0.045, 0.036, 0.028};
  double bump_m = 1.2e-3;
  double bump_length_m = 25e-3;
  double facet_m = 1.5e-3;

  template <class V>
  void visit(V& v) {
    v.field("seed", seed, "of the bumps", {0.0, 9e15});
    v.field("semi_axes_m", semi_axes_m, "of the ellipsoid under the bumps", {1e-3, 10.0});
    v.field("bump_m", bump_m, "root mean square height of the bumps", {0.0, 1.0});
    v.field("bump_length_m", bump_length_m, "least wavelength of the bumps; the longest is twice that", {1e-4, 10.0});
    v.field("facet_m", facet_m, "mean length of the edges", {1e-5, 1.0});
  }
};

// A pebble to scan where there is no mesh file: a closed mesh, outward normals, centre at the origin. The twenty
// faces of an icosahedron are cut into n² triangles, their corners moved out onto the ellipsoid, and each moved along
// its radius by a sum of 24 waves cos(k·p + φ) at the ellipsoid's point p, with wave vectors k of random direction and
// lengths between the two wavelengths. Edges differ by a factor of about two. The same config gives the same mesh.
// Throws Error for more than 2 million triangles or bumps of more than a tenth of the least semi-axis.
TriangleMesh make_pebble(const PebbleConfig& config = {});

}  // namespace asperity
