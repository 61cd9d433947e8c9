#pragma once

#include <string>
#include <vector>

#include "asperity/import/file_streams.h"

namespace asperity {

// How the poses' clock runs against the inertial sensor's: t_imu = t_pose + offset + drift (t_pose − t_middle).
struct ClockFit {
  bool is_determined = false;
  std::string by;         // what aligned them: "rotation" or "acceleration"
  std::string reason;     // why not
  double offset_s = 0.0;  // at t_middle
  double offset_sigma_s = 0.0;
  double drift = 0.0;          // s/s; 0 where the recording is too short for it
  double drift_sigma = 0.0;    // 0: the drift is not estimated
  double correlation = 0.0;    // of the two angular speeds at this offset
  std::int64_t middle_ns = 0;  // t_middle, on the poses' clock

  std::int64_t imu_time_ns(std::int64_t pose_t_ns) const;
};

// By the angular speed, which both see whatever their axes: the length of the mean rotation rate over 40 ms (two poses
// if those are further apart) on a grid of 5 ms, its cross-correlation over all offsets at which a fifth of the shorter
// stream overlaps (by FFT), normalised by the energy in the overlap; then, in windows of 5 s, Gauss-Newton steps on the
// offset between the two curves, and a straight line through the windows' offsets, whose standard errors are the
// result's. With fewer than four windows the drift is 0 and the offset's error the windows' scatter, or one grid step
// for one window. Interpolation between grid points adds 0.1 ms to the error of the offset, and as much over the
// windows' spread to that of the drift. Not determined where the poses turn by less than 0.1 rad/s RMS, or the
// correlation is below 0.8, or another peak, more than a second away, comes within 0.05 of it.
//
// Where there is no gyroscope or that is not determined, by the acceleration, of which knocks on a table are enough
// (one near the beginning and one near the end for the drift): likewise with the size of the specific force |a + g up|
// (motion_curves.h), up being whichever of `ups` agrees best. Each window's offset has its own standard error, from
// what is left of the difference of the two curves, and the line is fitted by these, from two windows on.
ClockFit align_clocks(const PoseStream& pose, const VectorStream& rate, const VectorStream& specific_force,
                      const std::vector<Eigen::Vector3d>& ups);

}  // namespace asperity
