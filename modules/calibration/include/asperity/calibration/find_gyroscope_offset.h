#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "asperity/calibration/find_static_poses.h"
#include "asperity/recording/recording.h"

namespace asperity {

struct GyroscopeOffset {
  Eigen::Vector3d counts = Eigen::Vector3d::Zero();
  Eigen::Vector3d stderr_counts = Eigen::Vector3d::Zero();
  Eigen::Vector3d scatter_counts = Eigen::Vector3d::Zero();  // standard deviation of a pose's mean
  std::size_t poses = 0;
};

// The gyroscope's reading in static intervals: the mean over `poses` (times as accelerometer_samples_of gives them) of
// its means in each. The standard error is that of the poses' means over √poses, so that slow drift counts. nullopt
// without a gyroscope or with fewer than three poses that have rows of it.
std::optional<GyroscopeOffset> find_gyroscope_offset(const Recording& recording, const std::vector<StaticPose>& poses);

}  // namespace asperity
