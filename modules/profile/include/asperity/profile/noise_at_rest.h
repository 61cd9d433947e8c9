#pragma once

#include <span>
#include <vector>

#include "asperity/profile/texture_noise.h"

namespace asperity {

// The corner f₁ of an acceleration's 1/f noise, of A (1 + f₁/f), and what is known of it.
struct NoiseAtRest {
  double corner_Hz = 1.0;         // expected value
  double corner_sigma_Hz = 1.72;  // standard deviation
  double rests_s = 0.0;           // of the rests that were used; 0: the corner is the assumed one
};

// The tip's acceleration in one direction, one value a sample, and the errors of a position in it as height_errors.h
// has them for the normal; their white noise and corner are not used.
struct AccelerationAtRest {
  std::vector<double> accel_mps2;
  HeightErrors errors;
};

// Of chips 0.05 to 5 Hz are usual: ln f₁ is normal about ln 0.5 Hz with σ = ln(10)/1.96, so that its expected value is
// 1 Hz. The data are the rests, runs of `resting` that last 1 s and more: there the tip stands on the surface, and what
// its acceleration shows is error, but for the hand's tremor. The axes of a chip are alike: all directions have one f₁.
//
// Each rest, without 0.15 s at its ends, is tapered (Hann) and transformed. A bin's power at the frequency f, from 1 to
// 6 Hz and where the tracker has less than a quarter of the motion, has an exponential distribution of the mean
//
//   S(f) = (2πf)⁴ S_h(f; w A, f₁/w) + M (f/3 Hz)²,
//
// S_h the density of a height's error (height_error_density.h) with `white_m2ps3` A for the acceleration, which is
// known to w = exp(± 0.3), and M the power of motion that is left: a hand that holds on shakes at 8 to 12 Hz, and its
// acceleration rises towards them. M is 0 or, as likely, ln M is uniform over six decades, in each direction. So a
// falling spectrum is noise, a rising one is motion. What the force's variation presses the tip in, −c d²F/dt² with one
// c ≥ 0 a direction, is taken off before by weighted least squares. Neighbouring bins of a Hann taper are not
// independent: the log-likelihood (Whittle's) is over 1.94, by which they raise the variance of a mean. The mean and
// the standard deviation of f₁ are sums over a grid. `force_N` may be empty or have nan; no force is taken off where a
// mean over 20 ms has none. Throws Error if the sizes differ.
NoiseAtRest noise_at_rest(std::span<const double> t_s, std::span<const double> force_N, std::span<const char> resting,
                          std::span<const AccelerationAtRest> directions, double white_m2ps3);

}  // namespace asperity
