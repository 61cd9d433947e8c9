#pragma once

#include <array>

#include "asperity/calibration/fit_accelerometer.h"
#include "force_poses.h"

namespace asperity {

// One model by least squares over poses (erratum 7). `terms` are the columns of φ that are fitted, one list an axis of
// the sensor: all alike but for scalar_offset.
AccelerometerModelFit fit_accelerometer_terms(const ForcePoses& poses, AccelerometerModel model,
                                              const std::array<std::vector<int>, 3>& terms);

// The terms of the quadric model that the poses determine: of those that they do not, the last squares are dropped
// first. Empty if the linear ones are among them, or if too few poses are left for the errors.
std::vector<int> determined_quadric_terms(const ForcePoses& poses, double least_relative_singular_value);

// The design matrix of `terms` and a column of ones.
Eigen::MatrixXd design_matrix(const ForcePoses& poses, const std::vector<int>& terms);

// Residual sums of squares of each sensor axis (row) over a line in each axis of the marker (column).
Eigen::Matrix3d line_sums(const ForcePoses& poses);

const char* term_name(int term);

}  // namespace asperity
