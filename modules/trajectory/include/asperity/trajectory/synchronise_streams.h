#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "asperity/geometry/pose.h"
#include "asperity/recording/recording.h"
#include "asperity/trajectory/reject_outliers.h"

namespace asperity {

// The probe's and the tracker's streams on one uniform time base, one entry a period.
struct SynchronisedStreams {
  std::vector<std::int64_t> t_ns;
  std::vector<Eigen::Vector3d> accel_counts;
  std::vector<double> force_counts;  // nan throughout if the probe sent no force at all
  std::vector<Pose> T_world_marker;
};

// Resamples both streams every `period_ns` over the time that they share (thesis §4.1, erratum 11):
// counts and positions by linear interpolation, orientations by SLERP (erratum 1). The tracker's times
// are first moved back by `latency_s` to when the image was taken. Rejected samples and empty cells are
// interpolated over; before the first and after the last force the nearest holds. With `average` a count is
// the mean of its interpolation over one period instead of its value in the middle: a probe faster than
// the new rate then does not fold its high frequencies into the height. Throws Error if
// period_ns is not positive, if a stream has fewer than two usable samples, or if they share less than
// one period.
SynchronisedStreams synchronise_streams(const ProbeStream& probe, const Outliers& outliers,
                                        const TrackerStream& tracker, double latency_s, std::int64_t period_ns,
                                        bool average);

}  // namespace asperity
