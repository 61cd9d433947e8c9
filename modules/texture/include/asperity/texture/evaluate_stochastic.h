#pragma once

#include "asperity/texture/series_state.h"
#include "asperity/texture/stochastic.h"

namespace asperity {

// What speed and force multiply σ by at most: wide enough for every texture, narrow enough that no exponent makes a
// force of it.
inline constexpr double kMostStochasticScale = 10.0;

struct StochasticHeight {
  double height_m = 0.0;      // above the geometric surface
  double above_mean_m = 0.0;  // of it, above the mean height; negative below
};

// The next height, metres, `dt_s` after the last, with the tip stroking at `speed_mps` under `force_N`. Inputs that are
// not finite or negative count as 0. Fixed time. Realtime-safe: yes. Thread-safe: yes, with a state each.
StochasticHeight next_stochastic_height(const StochasticTexture& texture, SeriesState& state, double speed_mps,
                                        double force_N, double dt_s) noexcept;

// Its height_m alone.
double next_height_m(const StochasticTexture& texture, SeriesState& state, double speed_mps, double force_N,
                     double dt_s) noexcept;

// The same as forces: the tip is taken to lie on the geometric surface, the whole height pressed in.
SeriesForce next_force(const StochasticTexture& texture, SeriesState& state, double speed_mps, double force_N,
                       double dt_s) noexcept;

}  // namespace asperity
