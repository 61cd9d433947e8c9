#pragma once

#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "asperity/tracking/solve_body_pose.h"
#include "pose_error.h"

namespace asperity {

struct LeastSquaresPose {
  Pose pose;
  double robust_cost = 0.0;  // comparable among minima of one problem
  double reprojection_px = 0.0;
  bool converged = false;
  std::vector<int> corners_of_tag;  // those with weight
  int corners_used = 0;
};

// The weighted least squares of solve_body_pose.
class BodyLeastSquares {
 public:
  BodyLeastSquares(const CameraCalibration& camera, const std::vector<MarkerPlacement>& body,
                   std::span<const SeenTag> seen, const BodyPoseConfig& config);

  // Σ log(1 + d²/loose²) over the corners' distances; nullopt if a corner is not in front of the camera.
  std::optional<double> loose_cost(const Pose& pose, double loose_px) const;

  // The minimum next to `start`. `corner_px` is the standard deviation of what each corner is off by beside its own
  // covariance.
  std::optional<LeastSquaresPose> minimise(const Pose& start, double corner_px = 0.0) const;

  // The corners at a minimum that minimise() found with the same `corner_px`, and its normal matrix; nullopt where that
  // is singular.
  struct AtMinimum {
    std::vector<CornersAtPose> corners;
    Eigen::Matrix<double, 6, 6> normal;
  };
  std::optional<AtMinimum> at_minimum(const LeastSquaresPose& minimum, double corner_px) const;

 private:
  struct Observation {
    Eigen::Matrix<double, 3, 4> p_marker_m;
    Eigen::Matrix<double, 2, 4> corners_px;
    Eigen::Matrix<double, 8, 8> covariance;  // px²
  };
  // A tag's inverse covariance.
  struct Metric {
    Eigen::Matrix<double, 8, 8> information;  // 1/px²
    Eigen::Matrix<double, 2, 8> own;          // each corner's own information, 2×2 blocks
  };
  struct Residuals {
    std::vector<Eigen::Matrix<double, 8, 1>> r_px;
    std::vector<Eigen::Matrix<double, 8, 6>> by_pose;
  };

  bool evaluate(const Pose& pose, Residuals& out, bool with_derivative) const;
  bool weigh_tags(const Residuals& at, double corner_px, std::vector<Metric>& out) const;
  // Squared distances of the corners in their own covariances, four a tag.
  void distances2(const Residuals& residuals, const std::vector<Metric>& metric, std::vector<double>& out) const;
  // The roots of the corners' robust weights; the scale of their distances.
  double reweigh(const Residuals& at, const std::vector<Metric>& metric, std::vector<double>& squares,
                 std::vector<double>& root_weights) const;

  const CameraCalibration* camera_;
  const BodyPoseConfig* config_;
  std::vector<Observation> observations_;
};

}  // namespace asperity
