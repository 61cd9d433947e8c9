#pragma once

#include <vector>

#include <Eigen/Core>

#include "asperity/import/file_streams.h"

namespace asperity {

// Rotations by the poses and by the gyroscope, from one stretch to the next.
struct RatePairs {
  std::vector<Eigen::Vector3d> pose_radps;  // in the body's axes
  std::vector<Eigen::Vector3d> gyro_radps;
  double stretch_s = 0.0;
  double noise2 = 0.0;          // what the poses' white noise has in Σ|pose_radps|², (rad/s)²
  double pose_noise_rad = 0.0;  // of one pose, RMS of the axes
};

// The mean rotations of the poses in one stretch after the other, and those of the integrated gyroscope at the same
// times: the rate is the rotation from a mean to the next over the time between. Both are averaged alike, so that they
// agree however far the body rotates. The stretches are 40 ms, or two poses if those are further apart, and are doubled
// up to 1.28 s until the poses' rotation has ten times the power of their noise; if none has, the one where it stands
// out most. Poses far off their neighbours are left out.
RatePairs pair_rates(const PoseStream& pose, const VectorStream& rate);

}  // namespace asperity
