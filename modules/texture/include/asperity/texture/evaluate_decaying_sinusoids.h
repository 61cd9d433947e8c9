#pragma once

#include "asperity/texture/decaying_sinusoids.h"
#include "asperity/texture/series_state.h"

namespace asperity {

// Begins a tap now. All taps of a texture share B and ω, so that their sum is one decaying oscillation: any number
// overlap. Inputs that are not finite or negative count as 0. Realtime-safe: yes. Thread-safe: yes, with a state each.
void start_tap(const DecayingSinusoids& texture, SeriesState& state, double speed_mps, double force_N) noexcept;

// The acceleration, m/s², `dt_s` after the last call; with a pitch, edges that the stroke crossed meanwhile begin. The
// first sample after start_tap() is that of t = dt_s. Fixed time. Realtime-safe and thread-safe as above.
double next_acceleration_mps2(const DecayingSinusoids& texture, SeriesState& state, double speed_mps, double force_N,
                              double dt_s) noexcept;

// The same times mass_kg. Without an offset: it is the ringing of the tool, not a height.
SeriesForce next_force(const DecayingSinusoids& texture, SeriesState& state, double speed_mps, double force_N,
                       double dt_s) noexcept;

}  // namespace asperity
