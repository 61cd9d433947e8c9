#pragma once

#include <span>
#include <vector>

#include "asperity/fidelity/path_grid.h"
#include "asperity/fidelity/stroke_signals.h"
#include "asperity/fidelity/virtual_probe.h"

namespace asperity {

// How a rendered surface yields and rubs.
struct RenderedContact {
  double stiffness_N_per_m = 1000.0;
  double friction = 0.0;
};

// What a probe would have measured over a rendered surface, one value a sample of the stroke.
struct RenderedStroke {
  std::vector<double> accel_mps2;    // along the normal, through the accelerometer's low-pass
  std::vector<double> force_N;       // the reading, through the sensor's pole
  std::vector<double> normal_N;      // through that pole
  std::vector<double> tangential_N;  // likewise, against the travel
};

// Leads a virtual tip over a relief under the hand of a stroke (docs/realism.md): it goes along the path as the stroke
// did, s(t), and along the normal, with u = z(s) − h its depth,
//
//   m ḧ = F − N₀(t) − k_h (h + N₀/k_s) − c_h ḣ,      F = max(0, k_s u + c u̇), 0 out of contact,    c = 2 ζ √(k_s m)
//   T = F (µ + dz/ds),      reading = F a·n − T a·t
//
// N₀ is the stroke's own normal force below `low_cycles_per_mm`. z is `relief_m`, on the grid, 0 where it is nan; its
// mean is taken off. Semi-implicit Euler, the step a tenth of √(m/k_s), at most 50 µs. Throws Error if sizes differ, a
// value is not positive, or the stroke is too long for its stiffness (more than 10⁸ steps).
RenderedStroke render_stroke(const StrokeSignals& stroke, const PathGrid& grid, std::span<const double> relief_m,
                             const RenderedContact& contact, const HandImpedance& hand, const VirtualProbeConfig& probe,
                             double low_cycles_per_mm);

}  // namespace asperity
