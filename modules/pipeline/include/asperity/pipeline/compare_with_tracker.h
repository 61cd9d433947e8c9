#pragma once

#include <cstddef>
#include <limits>

#include "asperity/profile/find_base_path.h"
#include "asperity/recording/recording.h"
#include "asperity/trajectory/trajectory_result.h"

namespace asperity {

// An estimated motion against what the poses alone say. nan: the poses do not allow it.
struct TrackerComparison {
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

  double pose_noise_m = kUnknown;     // standard deviation of the poses' white noise at the tip, mean of the axes
  double smoothing_s = kUnknown;      // half-width of the smoothing that the noise allows
  double departure_m = kUnknown;      // median distance of the estimated tip from the poses' tip
  double departure_ratio = kUnknown;  // over what the poses' noise alone would make

  double length_m = kUnknown;          // of the estimated path while in contact
  double length_stderr_m = kUnknown;   // by the motion's covariance at the ends; nan if it has none
  double tracker_length_m = kUnknown;  // of the poses' own path, over the same times, along the same base
  double tracker_length_stderr_m = kUnknown;
};

// The poses' own path, without poses that stand off from the median of their neighbours. Their white noise σ an axis is
// that of the fourth differences, which a smooth motion hardly enters: the median over windows of 32 poses. The path is
// smoothed by local parabolas with the weights (1 − (Δt/h)²)²; h is the one of 0.05 to 1.1 s at which the length's
// standard error is least.
//
// The length over the times in contact is Σ Δq·u, with q the path smoothed by the next narrower h and u the direction
// of the smoothed velocity less its part along the base path's normal: linear in the poses, so that noise does not
// lengthen it. Where the velocity is below three of its standard deviations the tip counts as resting. Standard error:
// the noise of q at the ends and where u turns; what noise in u adds; how far q is at the end of each rest from its
// beginning; the difference from the next narrower h, or from any narrower one less that one's noise, if that is more;
// half of what the smoothed speed lacks where the path turns round by more than 60° within h (a raster's bends); and
// 0.5 % of the length, for the base shape. A smoothing in which noise lets the tip seem at rest, between its first and
// last motion, for more of the path than it measures is not used. The white noise counts twice, a measured margin for
// rests. The slow part of the poses' noise, which is not in their differences, goes through the same smoothing with its
// own correlation exp(−Δt/time): its size and time are those that the trajectory has learnt (tracker_slow_sigma_m,
// …_rad times the tip's distance, tracker_slow_time_s), otherwise those that the calibration states.
TrackerComparison compare_with_tracker(const Recording& recording, const TrajectoryResult& trajectory,
                                       const BasePathResult& base);

}  // namespace asperity
