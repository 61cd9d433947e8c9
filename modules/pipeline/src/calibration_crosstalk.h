#pragma once

#include <span>
#include <vector>

#include "asperity/geometry/motion.h"
#include "asperity/profile/base_path.h"
#include "asperity/profile/texture_noise.h"

namespace asperity {

// Standard deviations of a calibration's errors, each entry its own.
struct CalibrationErrors {
  double accel_matrix = 0.0;                                    // of (1 + E_a) f, marker axes
  double gyro_matrix = 0.0;                                     // of (1 + E_g) omega
  Eigen::Vector3d tip_m = Eigen::Vector3d::Zero();              // of the tip in the marker
  Eigen::Vector3d tip_from_sensor_m = Eigen::Vector3d::Zero();  // marker axes
};

// The one-sided density, over time frequency, of what the errors carry from the measured motion into the height, before
// a tracker corrects it: of the specific force across the normal through E_a, nᵀ R E_a f twice integrated; of rotations
// through E_g, nᵀ (R E_g θ × arm); of rotations through the tip's place, nᵀ R δτ. And that of the sway across the path
// times the tangent of `lean_rad`, the standard deviation of the normals' lean. Over the samples with `moving` set.
// Writes errors.crosstalk_* and leaning_m2ps; leaves them empty where the motion is shorter than two stretches of 1.3
// s.
void add_crosstalk(const TipMotion& motion, const BasePath& base, std::span<const char> moving,
                   const Eigen::Vector3d& gravity_world_mps2, const CalibrationErrors& calibration, double lean_rad,
                   HeightErrors& errors);

}  // namespace asperity
