#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "asperity/geometry/triangle_mesh.h"

namespace asperity::testkit {

// A star-shaped surface about the origin: in the unit direction u it lies at the distance
//   r(u) = radius_m + rms_m √(2/W) Σ_{w=1..W} sin(2π radius_m / wavelength_w  e_w·u + φ_w),
// with random unit e_w, phases and wavelengths between the two given. A point moved radially below a crest whose
// radius of curvature is smaller than its depth is beyond the crest's centre: there the closest point jumps.
struct BumpySphere {
  double radius_m = 50e-3;
  double rms_m = 0.35e-3;
  double shortest_wave_m = 5e-3;
  double longest_wave_m = 9e-3;
  int waves = 8;
  std::uint64_t seed = 1;
};

// An icosahedron, each edge cut in `frequency`, its vertices moved onto that surface: 20 frequency² triangles, facing
// outwards. 59 gives 69,620 of about 1 mm edge at 50 mm, 224 gives 1,003,520. No waves give a sphere.
TriangleMesh bumpy_sphere_mesh(int frequency, const BumpySphere& shape = {});

}  // namespace asperity::testkit
