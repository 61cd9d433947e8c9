#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "asperity/base/problem.h"
#include "asperity/calibration/calibration_verdict.h"
#include "asperity/calibration/series_noise.h"
#include "asperity/geometry/pose.h"
#include "asperity/recording/tracker_noise_model.h"

namespace asperity {

// The tracker's scatter while the marker body was stationary.
struct StaticInterval {
  std::string recording;
  std::int64_t start_ns = 0;
  std::int64_t end_ns = 0;
  std::size_t outliers = 0;  // poses far off all others, left out
  Pose T_world_marker;       // the mean
  double distance_m = 0.0;   // from the camera; 0 unless the world is the camera's frame
  double tilt_rad = 0.0;     // between the best-facing tag's normal and the ray to it; 0 likewise

  std::array<SeriesNoise, 3> position_m;    // along the world's axes
  std::array<SeriesNoise, 3> rotation_rad;  // about the world's axes
  // In the ray's frame: two across (up to their order alike), then along; about the same axes.
  std::array<SeriesNoise, 3> ray_position_m;
  std::array<SeriesNoise, 3> ray_rotation_rad;
  std::vector<Eigen::Vector3d> deviation_m;  // of every pose used from the mean position, along the world's axes
};

struct TrackerNoise {
  Eigen::Vector3d sigma_position_m = Eigen::Vector3d::Zero();  // the white part, over all static intervals
  Eigen::Vector3d sigma_position_error_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d sigma_rotation_rad = Eigen::Vector3d::Zero();
  Eigen::Vector3d sigma_rotation_error_rad = Eigen::Vector3d::Zero();
  Eigen::Vector3d slow_position_m = Eigen::Vector3d::Zero();  // the drift, over all static intervals
  Eigen::Vector3d slow_rotation_rad = Eigen::Vector3d::Zero();
  bool gaussian = true;  // no channel refuses it by more than chance, or by little
  bool moving = false;   // the drift is larger than the white part
  std::vector<StaticInterval> rests;
  std::optional<TrackerNoiseModel> model;
  std::string no_model_because;
  Problems problems;
  CalibrationVerdict verdict;
};

}  // namespace asperity
