#pragma once

#include <cstdint>
#include <span>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "asperity/recording/calibration.h"

namespace asperity {

inline double in_seconds(std::int64_t ns) { return static_cast<double>(ns) * 1e-9; }

// The covariance of the tip's position that a pose alone gives, world axes, m²: the position's own variance, and
// [a]× Σ_R [a]×ᵀ with a = R tip_in_marker, for a rotation error δ moves the tip by δ × a. By the calibration's constant
// σ.
Eigen::Matrix3d tip_covariance_m2(const TrackerCalibration& tracker, const Eigen::Quaterniond& q_world_marker,
                                  const Eigen::Vector3d& tip_in_marker_m);

// What an error of the tip's place in the marker, constant in the marker, is in the world: R Σ Rᵀ, m².
Eigen::Matrix3d tip_place_covariance_m2(const Calibration& calibration, const Eigen::Quaterniond& q_world_marker);

// The diagonal of tip_covariance_m2, averaged over the recording so that R is constant, as the seed's is.
Eigen::Vector3d mean_tip_variance_m2(const TrackerCalibration& tracker,
                                     std::span<const Eigen::Quaterniond> q_world_marker,
                                     const Eigen::Vector3d& tip_in_marker_m);

}  // namespace asperity
