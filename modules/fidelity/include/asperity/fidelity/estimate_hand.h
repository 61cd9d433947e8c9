#pragma once

#include "asperity/fidelity/path_grid.h"
#include "asperity/fidelity/stroke_signals.h"
#include "asperity/fidelity/virtual_probe.h"

namespace asperity {

// The impedance of probe and hand from one stroke's own signals, without any texture: in the band, over the path,
//
//   f + P[N₀ σ a·t] = P[(a·n − µ a·t) (m ḧ + c ḣ + k h)],    σ = ḣ / v,    m, c, k ≥ 0
//
// by least squares, the third octaves weighted by the inverse of the density that is left over in them (tremor presses
// too, and is not a response of the hand); f is the reading, P the pole of the force sensor, N₀ the slow normal force,
// µ = 0.25 (its part is small), h the tip's height, v its speed along the path (docs/realism.md). Not measured, and
// what the config assumes, where m is below three of its standard errors.
HandImpedance estimate_hand(const StrokeSignals& stroke, const PathGrid& grid, double segment_m,
                            double low_cycles_per_mm, double high_cycles_per_mm, const VirtualProbeConfig& config);

}  // namespace asperity
