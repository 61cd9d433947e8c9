#pragma once

#include "asperity/texture/series_state.h"
#include "asperity/texture/stochastic.h"

namespace asperity {

// The next height above the geometric surface, metres, `dt_s` after the last, with the tip stroking at
// `speed_mps` under `force_N`. Inputs that are not finite or negative count as 0. Fixed time.
// Realtime-safe: yes. Thread-safe: yes, with a state each.
double next_height_m(const StochasticTexture& texture, SeriesState& state, double speed_mps, double force_N,
                     double dt_s) noexcept;

// The same as forces: the tip is taken to lie on the geometric surface, the whole height pressed in.
SeriesForce next_force(const StochasticTexture& texture, SeriesState& state, double speed_mps, double force_N,
                       double dt_s) noexcept;

}  // namespace asperity
