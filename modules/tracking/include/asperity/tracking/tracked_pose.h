#pragma once

#include <limits>
#include <vector>

#include <Eigen/Core>

#include "asperity/recording/recording_appender.h"

namespace asperity {

// A tag as it was found in an image.
struct TagDetection {
  int id = 0;
  Eigen::Matrix<double, 2, 4> corners_px;  // its black border's corners, in the order of the tag's own frame
};

// A pose of the marker body with what is known of its error.
struct TrackedPose {
  TrackerSample sample;  // in the camera's frame
  // Of (position, m; rotation vector, rad), both along the world's axes: T_world_marker = (exp(δφ) R, t + δt). nan
  // where unknown.
  Eigen::Matrix<double, 6, 6> covariance =
      Eigen::Matrix<double, 6, 6>::Constant(std::numeric_limits<double>::quiet_NaN());
  // The part of it that is of this frame alone: without what the camera's calibration and the body's make wrong in all.
  Eigen::Matrix<double, 6, 6> noise = Eigen::Matrix<double, 6, 6>::Constant(std::numeric_limits<double>::quiet_NaN());
  std::vector<TagDetection> tags;  // those used
  bool ambiguous = false;          // the other way in which the tags' plane can lie fits nearly as well
};

// The pose as a row, its covariance as standard deviations.
inline TrackerSample with_sigmas(const TrackedPose& pose) {
  TrackerSample out = pose.sample;
  const Eigen::Matrix<double, 6, 1> variance = pose.covariance.diagonal();
  if (!(variance.array() >= 0.0).all()) return out;
  out.sigma_position_m = variance.head<3>().cwiseSqrt();
  out.sigma_rotation_rad = variance.tail<3>().cwiseSqrt();
  const Eigen::Matrix<double, 6, 1> own = pose.noise.diagonal();
  if (!(own.array() >= 0.0).all()) return out;
  out.noise_position_m = own.head<3>().cwiseSqrt();
  out.noise_rotation_rad = own.tail<3>().cwiseSqrt();
  return out;
}

}  // namespace asperity
