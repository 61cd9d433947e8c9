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

namespace asperity {

// The tracker's scatter while the marker body rested in one place.
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

// σ = scale · (distance / 1 m)^power · cos(tilt)^−tilt_power, for the white part.
struct NoiseLaw {
  double scale = 0.0;  // m or rad, at 1 m and facing the camera
  double scale_error = 0.0;
  double power = 0.0;  // of the distance, as geometry demands
  double tilt_power = 0.0;
  double tilt_power_error = 0.0;
  bool tilt_fitted = false;     // false: the rests are too much alike, tilt_power is 0
  double measured_power = 0.0;  // the power that the data themselves have, for comparison
  double measured_power_error = 0.0;
  double chi_square = 0.0;  // of the fit with the power held
  int degrees_of_freedom = 0;
};

struct TrackerNoiseModel {
  NoiseLaw across_m, along_m;    // the ray; powers 1 and 2
  NoiseLaw about_rad, tilt_rad;  // about the ray, and about axes across it; powers 1 and 2
  double nearest_m = 0.0, farthest_m = 0.0, steepest_rad = 0.0;  // where it was measured
};

struct TrackerNoise {
  Eigen::Vector3d sigma_position_m = Eigen::Vector3d::Zero();  // the white part, over all rests
  Eigen::Vector3d sigma_position_error_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d sigma_rotation_rad = Eigen::Vector3d::Zero();
  Eigen::Vector3d sigma_rotation_error_rad = Eigen::Vector3d::Zero();
  Eigen::Vector3d slow_position_m = Eigen::Vector3d::Zero();  // the slow part, over all rests
  Eigen::Vector3d slow_rotation_rad = Eigen::Vector3d::Zero();
  bool gaussian = true;  // no channel refuses it by more than chance, or by little
  bool moving = false;   // the slow part is larger than the white one
  std::vector<StaticInterval> rests;
  std::optional<TrackerNoiseModel> model;
  std::string no_model_because;
  Problems problems;
  CalibrationVerdict verdict;
};

}  // namespace asperity
