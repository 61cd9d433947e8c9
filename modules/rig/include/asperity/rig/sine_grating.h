#pragma once

#include "asperity/base/config.h"
#include "asperity/geometry/triangle_mesh.h"

namespace asperity {

// A sine z = depth/2 · sin(2πx/pitch), known in pitch and depth: what a rig is checked on (docs/check-rig.md).
struct SineGratingConfig {
  double pitch_m = 2e-3;
  double depth_m = 0.2e-3;

  template <class V>
  void visit(V& v) {
    v.field("pitch_m", pitch_m, "period of the artefact, as measured, m", {0.1e-3, 20e-3});
    v.field("depth_m", depth_m, "from its valleys to its peaks, as measured, m", {1e-6, 5e-3});
  }
};

struct SineGratingShape {
  int periods = 50;
  int steps = 20;          // corners a period; the chords cut depth/2 · (1 − cos(π/steps)) off the peaks
  double width_m = 16e-3;  // of the full relief
  double ramp_m = 2e-3;    // on either side, from the relief to the flat rim
  double rim_m = 5e-3;     // on either side
  double land_m = 8e-3;    // flat, before and after the relief
  double height_m = 5e-3;  // of rim and lands over the bottom
};

// The artefact as a closed mesh, outward normals: x along the relief, z up, the bottom at z = 0; relief, rim and lands
// share the level height_m, so that the volume is that of the box. Throws Error for a shape without extent, one that
// the depth cuts through, or more than a million triangles.
TriangleMesh make_sine_grating(const SineGratingConfig& sine, const SineGratingShape& shape = {});

// The height over its mean line of the grating as a ball of radius `tip_radius_m` traces it (the lowest point of the
// ball that rests on it), at the phase 2πs/pitch of the ball's centre. The peaks' and valleys' heights stay as they
// are as long as the ball reaches into the valleys; the flanks rise by about r z'²/2, which adds a second
// harmonic of amplitude r (π depth/pitch)²/4, and takes a little of the fundamental.
// Throws Error if the ball does not reach: r ≥ pitch²/(2π² depth).
class TracedSine {
 public:
  TracedSine(const SineGratingConfig& sine, double tip_radius_m);
  double height_m(double phase_rad) const;
  // Amplitude of the fundamental of height_m over that of the sine, at most 1.
  double fundamental_share() const;

 private:
  double amplitude_m_, slope_, reach_rad_;  // of the sine; k r
};

}  // namespace asperity
