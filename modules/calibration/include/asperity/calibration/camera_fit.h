#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "asperity/base/problem.h"
#include "asperity/calibration/calibration_verdict.h"
#include "asperity/geometry/pose.h"
#include "asperity/recording/calibration.h"

namespace asperity {

inline constexpr std::size_t kCameraParameters = 9;
inline constexpr std::array<std::string_view, kCameraParameters> kCameraParameterNames{"fx", "fy", "cx", "cy", "k1",
                                                                                       "k2", "p1", "p2", "k3"};
using CameraVector = Eigen::Matrix<double, kCameraParameters, 1>;
using CameraMatrix = Eigen::Matrix<double, kCameraParameters, kCameraParameters>;

// fx, fy, cx, cy in px, then k1, k2, p1, p2, k3.
CameraVector camera_parameters(const CameraCalibration& camera);

// One image of the board in the fit.
struct CameraFitView {
  std::string name;
  std::size_t corners = 0;
  double rms_px = 0.0;    // of the distances between the corners found and projected
  double tilt_rad = 0.0;  // of the board against the image plane
  Pose T_camera_board;
  bool used = true;  // false: left out, its corners disagree with all others'
};

// A camera's intrinsic parameters with what is known of their errors.
struct CameraFit {
  CameraCalibration camera;
  CameraVector standard_error = CameraVector::Constant(std::numeric_limits<double>::quiet_NaN());  // k3: 0 if held at 0
  CameraMatrix covariance = CameraMatrix::Zero();
  bool k3_free = false;
  double k3_over_error = 0.0;  // of the fit with k3 free

  std::vector<CameraFitView> views;
  double rms_px = 0.0;           // over all corners used
  double corner_sigma_px = 0.0;  // of one coordinate of a corner, with the degrees of freedom
  // Variance between views over that within views, 1 if corners err independently; and its own standard error.
  double dispersion = 1.0;
  double dispersion_error = 0.0;
  bool errors_scaled = false;  // by the root of the dispersion, which is above 1 by more than chance

  double coverage = 0.0;  // share of the image within the hull of all corners
  double steepest_tilt_rad = 0.0;
  int iterations = 0;
  bool converged = false;
  Problems problems;
  CalibrationVerdict verdict;
};

}  // namespace asperity
