#pragma once

#include "asperity/recording/recording.h"
#include "asperity/trajectory/causal_feed_config.h"
#include "asperity/trajectory/estimate_trajectory_fused.h"
#include "asperity/trajectory/trajectory_result.h"

namespace asperity {

// The tip's motion at the probe's samples by one pass of an error-state extended Kalman filter: the filter of `fused`
// (docs/trajectory.md) without its smoother, its repetitions and all that it learns from the recording as a whole. The
// state at a sample is dead reckoning from the last pose before it. Nothing is learnt from the future: the state at a
// time depends on rows and poses taken before it, but that rows are cleaned (clock, spikes, clipped peaks, noise) in
// blocks of feed.block_s and that the first state takes feed.start_s of poses, after which the output begins. The
// factor on the process noise is found as the samples come (three filters side by side, noise_scale.h) unless
// model.process_noise_scale sets it; poses outside model.gate_chi2 of their innovation lose weight as there.
//
// Covariances at samples lie linearly between those after the pose before and before the pose after. metrics:
// poses_used, process_noise_scale, latency_s. Throws Error if fewer than four poses lie within the probe's time or the
// estimate is not finite.
TrajectoryResult estimate_trajectory_ekf(const Recording& recording, const FusedConfig& model,
                                         const CausalFeedConfig& feed, const Observer& observer = {});

}  // namespace asperity
