#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "asperity/base/config.h"
#include "asperity/base/units.h"
#include "asperity/calibration/accelerometer_samples.h"
#include "asperity/calibration/calibration_verdict.h"
#include "asperity/calibration/find_static_poses.h"
#include "asperity/recording/calibration.h"

namespace asperity {

struct AccelerometerFieldConfig {
  double gravity_mps2 = kStandardGravity_mps2;
  int fewest_poses = 12;
  double least_spread = 0.01;
  double outlier_sigmas = 5.0;
  double residual_share = 0.01;
  double uncertainty_share = 0.005;
  FindStaticPosesConfig poses;

  template <class V>
  void visit(V& v) {
    v.field("gravity_mps2", gravity_mps2, "strength of gravity at the place of the calibration, m/s^2", {9.7, 9.9});
    v.field("fewest_poses", fewest_poses, "fewer poses are refused", {10, 1000});
    v.field("least_spread", least_spread,
            "the poses' directions are refused if the design's least singular value over the root of their number is "
            "below",
            {0.0, 1.0});
    v.field("outlier_sigmas", outlier_sigmas, "a pose further off than this is left out, standard deviations",
            {3.0, 100.0});
    v.field("residual_share", residual_share, "largest residual of a valid one, share of gravity", {0.0, 1.0});
    v.field("uncertainty_share", uncertainty_share,
            "largest standard error of scale, bias and angles, else limited, share (rad)", {0.0, 1.0});
    v.group("poses", poses);
  }
};

struct FieldPose {
  StaticPose pose;
  Eigen::Vector3d specific_force_mps2 = Eigen::Vector3d::Zero();  // by the calibration found
  double residual_mps2 = 0.0;                                     // |f| − g
  bool used = true;                                               // false: left out as an outlier
};

struct AccelerometerFieldResult {
  // Linear, B lower triangular with a positive diagonal, rotation_known = false.
  AccelerometerCalibration accelerometer;
  Eigen::Vector3d scale_counts_per_mps2 = Eigen::Vector3d::Zero();  // of i, j, k: the lengths of B's rows
  Eigen::Vector3d scale_stderr = Eigen::Vector3d::Zero();
  Eigen::Vector3d bias_stderr_counts = Eigen::Vector3d::Zero();
  // Between i and j, i and k, j and k: by how much their angle is short of 90°.
  Eigen::Vector3d misalignment_rad = Eigen::Vector3d::Zero();
  Eigen::Vector3d misalignment_stderr_rad = Eigen::Vector3d::Zero();
  double residual_counts = 0.0;  // of a pose, along the gradient; standard deviation with poses used − 9 degrees
  double rms_mps2 = 0.0;         // of |f| − g over the poses used
  double rms_all_mps2 = 0.0;     // over all poses found
  double spread = 0.0;           // least singular value of the design over √poses
  std::vector<FieldPose> poses;
  std::size_t used = 0;
  double still_counts = 0.0;
  CalibrationVerdict verdict;
};

// The accelerometer from gravity alone: held still in a few dozen directions, every mean reading lies on the
// ellipsoid counts = B f + C, |f| = g. Nine parameters; a rotation of f changes nothing, so B is taken lower
// triangular, which lays the sensor's i axis on x and its j axis into the x-y plane (thesis §3.5, reference [12] there;
// errata 5 and 7). Maximum likelihood for equal noise of the pose means on the three axes: the distances from the
// ellipsoid in counts, d = (|f| − g)/|B⁻ᵀ f/|f||, are made least by Gauss–Newton steps (Sampson's first order; the
// next is smaller by noise/radius). Huber weights first, then poses beyond `outlier_sigmas` of the residuals' median
// deviation are left out and the rest fitted plainly.
//
// The noise of a pose's mean is taken from the residuals of the poses, not from the scatter of the rows within one:
// rows a few milliseconds apart share the sensor's drift, and their scatter over √n is far too small. Each pose counts
// once, so the standard errors s·√diag((JᵀJ)⁻¹) with N − 9 degrees of freedom are true as long as poses err alike and
// independently.
//
// Throws Error, saying what to record, for too few poses, for poses whose directions do not determine the parameters,
// and for readings that lie on no ellipsoid.
AccelerometerFieldResult calibrate_accelerometer_field(const AccelerometerSamples& samples,
                                                       const AccelerometerFieldConfig& config = {});

}  // namespace asperity
