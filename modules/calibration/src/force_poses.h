#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "asperity/calibration/accelerometer_samples.h"

namespace asperity {

// (x, y, z, x², y², z², xy, xz, yz) as AccelerometerCalibration orders them.
Eigen::Matrix<double, 9, 1> quadric_features(const Eigen::Vector3d& f);

// Means over poses in the order of time: row p of `counts` belongs to row p of `features`.
struct ForcePoses {
  Eigen::MatrixXd counts;    // poses × 3
  Eigen::MatrixXd features;  // poses × 9

  Eigen::Index size() const { return counts.rows(); }
};

// Rows whose force stays within `near_mps2` of their first row's are one pose; stretches shorter than a tenth of the
// length in which half of all rows lie are turns between poses and left out.
ForcePoses group_by_force(const AccelerometerSamples& samples, double near_mps2);

// Means of pairs of neighbours; an odd last one is left out.
ForcePoses average_pairs(const ForcePoses& poses);

}  // namespace asperity
