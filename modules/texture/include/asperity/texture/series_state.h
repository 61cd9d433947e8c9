#pragma once

#include <array>
#include <cstdint>
#include <type_traits>

#include "asperity/base/random.h"

namespace asperity {

// The highest order of a series texture's filters, numerator and denominator.
inline constexpr int kMaxSeriesOrder = 32;

// What a series texture remembers from one servo step to the next. It belongs to the contact, not to the
// texture: two fingers on one texture have two. Plain data of fixed size, copied by assignment; begin with
// start_series(), and again when the texture is exchanged.
struct SeriesState {
  Random random{0};
  double phase = 0.0;     // of the model's sample period, or metres since the last impulse or edge
  double previous = 0.0;  // the model's last two samples
  double current = 0.0;
  int triangle = 0;                                    // of the speed-force plane, where the last point was found
  std::array<double, kMaxSeriesOrder + 1> backward{};  // normalised backward errors of the lattice
  std::array<double, kMaxSeriesOrder + 1> pole_output{};
  std::array<double, 2> ringing{};  // A e^(-Bt) (cos ωt, sin ωt), all taps together
};
static_assert(std::is_trivially_copyable_v<SeriesState>);

// The force of a texture at one servo step: outwards along the surface normal, and along the direction
// of motion (against it where negative).
struct SeriesForce {
  double normal_N = 0.0;
  double tangential_N = 0.0;
};

// A state without motion. One seed and stream give one series; streams of one seed are independent. The states of the
// lattice are drawn from their stationary distribution, so that there is no transient to wait for.
SeriesState start_series(std::uint64_t seed, std::uint64_t stream = 0);

}  // namespace asperity
