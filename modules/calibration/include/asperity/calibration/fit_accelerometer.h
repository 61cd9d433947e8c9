#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "asperity/base/config.h"
#include "asperity/calibration/accelerometer_samples.h"
#include "asperity/calibration/calibration_verdict.h"
#include "asperity/recording/calibration.h"

namespace asperity {

enum class AccelerometerChoice { kAuto, kScalarOffset, kLinear, kQuadric };
inline constexpr std::array<std::string_view, 4> kAccelerometerChoiceNames{"auto", "scalar_offset", "linear",
                                                                           "quadric"};

struct FitAccelerometerConfig {
  AccelerometerChoice model = AccelerometerChoice::kAuto;
  double same_pose_mps2 = 0.2;
  int fewest_poses = 6;
  double least_spread = 0.1;
  double least_relative_singular_value = 0.02;
  double uncertainty_share = 0.05;

  template <class V>
  void visit(V& v) {
    v.choice("model", model, kAccelerometerChoiceNames, "the model that is handed on; auto: by Schwarz's criterion");
    v.field("same_pose_mps2", same_pose_mps2, "rows whose force stays this near to their first are one pose, m/s^2",
            {0.0, 100.0});
    v.field("fewest_poses", fewest_poses, "fewer poses are refused", {5, 100000});
    v.field("least_spread", least_spread,
            "the poses' directions are refused if the design's least singular value over the root of their number is "
            "below",
            {0.0, 1.0});
    v.field("least_relative_singular_value", least_relative_singular_value,
            "below this share of the greatest a combination of parameters counts as not determined", {1e-12, 1.0});
    v.field("uncertainty_share", uncertainty_share, "largest standard error, else limited, share of the scale",
            {0.0, 1.0});
  }
};

// One model fitted to all three axes.
struct AccelerometerModelFit {
  AccelerometerCalibration accelerometer;  // with residual_counts and standard_errors
  int parameters = 0;                      // an axis
  int degrees_of_freedom = 0;              // an axis: poses − parameters
  int significant = 0;                     // parameters of B, of all axes, beyond three standard errors
  double bic = 0.0;                        // Schwarz's criterion over the three axes; smaller is better
  double better_probability = 1.0;         // F-test: that chance alone improves on the model before by as much
  std::vector<std::string> dropped;        // terms that the data do not determine, "z²"; their entries of B are zero
  // Covariance of an axis's parameters over its residual variance, (GᵀG)⁻¹; the order of B's columns, then C, those
  // that were not fitted left out. For scalar_offset that of axis i.
  Eigen::MatrixXd cofactor;
};

struct AccelerometerFit {
  AccelerometerCalibration accelerometer;     // the chosen model
  std::vector<AccelerometerModelFit> models;  // scalar_offset, linear and, where the poses allow it, quadric
  std::size_t chosen = 0;                     // among `models`
  std::string reason;                         // why, in words
  std::array<int, 3> marker_axis{0, 1, 2};    // scalar_offset: the marker's axis that i, j and k were taken to read
  std::size_t rows = 0;
  std::size_t poses = 0;
  std::size_t joined = 1;    // neighbours in time that were averaged until their errors were independent
  double correlation = 0.0;  // of the linear model's residuals from pose to pose, after that
  double spread = 0.0;       // least singular value of (f/|f|, 1) over √poses
  CalibrationVerdict verdict;
};

// The accelerometer's models counts = B φ(f) + C (thesis §3.5, errata 5–7) from readings under a specific force f that
// is known from elsewhere, such as a robot's or a tilting table's orientation:
//   scalar_offset  one factor and offset an axis, φ the marker's axis that fits it best (each axis is used once)
//   linear         φ = (x, y, z)
//   quadric        φ = (x, y, z, x², y², z², xy, xz, yz)
// Rows whose f stays near are one pose, and each pose enters as the means of its counts and of its φ, once: rows within
// a pose share their error, so that σ_fit·√diag((GᵀG)⁻¹) over all rows would be far too small (erratum 7 presumes
// independent rows). Poses are taken alike; stretches much shorter than most are rotations between poses and left out.
// If the residuals of poses next to each other in time are still correlated, neighbours are averaged in twos, fours and
// so on until they are not, which costs precision and never truth: the model is as linear in φ's means as in φ.
// Least squares by the SVD of G with its columns scaled to length one; N − k degrees of freedom an axis. Under gravity
// alone x² + y² + z² is constant: a term that the singular values show to be undetermined is dropped and named.
// Errors of f are neglected. Throws Error, saying what to record, for too few poses or for directions that do not
// determine the linear model.
AccelerometerFit fit_accelerometer(const AccelerometerSamples& samples, const FitAccelerometerConfig& config = {});

}  // namespace asperity
