#pragma once

#include <cstdint>

#include "asperity/base/config.h"
#include "asperity/recording/recording.h"
#include "asperity/trajectory/causal_feed_config.h"
#include "asperity/trajectory/estimate_trajectory_fused.h"
#include "asperity/trajectory/trajectory_result.h"

namespace asperity {

struct ParticleConfig {
  CausalFeedConfig feed;
  int particles = 64;
  std::int64_t seed = 1;
  double wild_begins = 0.005;
  double wild_goes_on = 0.5;
  double wild_position_m = 0.01;
  double wild_rotation_rad = 0.5;
  double largest_scale = 1e4;
  double scale_walk_per_rts = 0.7;
  double scale_jumps_Hz = 1.0;

  template <class V>
  void visit(V& v) {
    v.group("feed", feed);
    v.field("particles", particles, "number of them", {1, 100000});
    v.field("seed", seed, "of their randomness; the same seed gives the same bytes", {0.0, 9e15});
    v.field("wild_begins", wild_begins, "chance that a pose is wild after a good one", {0.0, 0.99});
    v.field("wild_goes_on", wild_goes_on, "chance that it is after a wild one", {0.0, 0.99});
    v.field("wild_position_m", wild_position_m, "standard deviation of a wild pose's position, m", {1e-4, 10.0});
    v.field("wild_rotation_rad", wild_rotation_rad, "standard deviation of a wild pose's orientation, rad",
            {1e-3, 3.0});
    v.field("largest_scale", largest_scale, "greatest factor on the process noise that a particle begins with",
            {1.0, 1e6});
    v.field("scale_walk_per_rts", scale_walk_per_rts, "random walk of that factor's natural logarithm, 1/sqrt(s)",
            {0.0, 100.0});
    v.field("scale_jumps_Hz", scale_jumps_Hz, "how often a particle draws that factor again, from where it began",
            {0.0, 1e3});
  }
};

// The tip's motion at the probe's samples by a Rao–Blackwellised particle filter (Doucet, de Freitas, Murphy and
// Russell, 2000; docs/comparison-methods.md has the formulae). What is not Gaussian is in the particles: whether each
// pose is good or wild, a Markov chain, and two factors on the process noise, of the accelerometer and of the gyroscope
// (without one, of the angular acceleration), a random walk in the logarithm with jumps (a static interval ends from
// one pose to the next). What is linear and Gaussian but for rotations, given these, is a filter of its own in each
// particle: that of estimate_trajectory_ekf.h, without its gate. The indicator is drawn from its posterior given the
// pose, so that a particle's weight is multiplied by
//
//   p(z | past) = P(good) N(y; 0, S) + P(wild) N(y; 0, wild² 1)
//
// and does not depend on what is drawn. Systematic resampling when the effective number falls below half. Causal as the
// EKF is. The estimate is the mean of the particles' Gaussians, its covariance theirs and that of their means.
//
// With `wild_begins` 0 and model.process_noise_scale set all particles are one and the same filter. metrics:
// poses_used, poses_wild (expected), process_noise_scale (geometric mean), particles_effective_least, resampled. Throws
// Error if fewer than four poses lie within the probe's time or the estimate is not finite.
TrajectoryResult estimate_trajectory_particle(const Recording& recording, const FusedConfig& model,
                                              const ParticleConfig& config, const Observer& observer = {});

}  // namespace asperity
