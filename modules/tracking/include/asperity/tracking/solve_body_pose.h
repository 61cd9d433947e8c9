#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "asperity/geometry/pose.h"
#include "asperity/recording/calibration.h"
#include "asperity/tracking/seen_tag.h"

namespace asperity {

struct BodyPoseConfig {
  double corner_sigma_px = 0.1;      // error of a coordinate of a corner that brings no covariance
  double placement_sigma_m = 0.0;    // of each tag's position on the body, in each direction
  double unmodelled_px = 0.002;      // error of corners in addition to their noise, before the frame has shown it
  double print_scale_error = 0.002;  // of the body's size against what is stated, share
  double bend_share = 0.001;         // sag of a plane of tags, as a share of its extent
  double focal_error = 0.003;        // of a camera whose calibration states no errors, share; its centre by as much
  double distortion_error = 0.01;    // of k1 of such a camera
  double outlier_sigmas = 6.0;       // a corner farther off than this has no weight
  double ambiguous_ratio =
      3.0;  // ratio of the residuals of the runner-up and the best, below which they are not distinguished
  int most_iterations = 30;

  template <class V>
  void visit(V& v) {
    v.field("corner_sigma_px", corner_sigma_px, "error of a coordinate of a corner that brings no covariance",
            {1e-4, 10.0});
    v.field("placement_sigma_m", placement_sigma_m, "of each tag's position on the body, in each direction",
            {0.0, 0.1});
    v.field("unmodelled_px", unmodelled_px,
            "error of corners in addition to their noise, before the frame has shown it", {1e-4, 10.0});
    v.field("print_scale_error", print_scale_error, "of the body's size against what is stated, share", {0.0, 0.5});
    v.field("bend_share", bend_share, "sag of a plane of tags, as a share of its extent", {0.0, 0.5});
    v.field("focal_error", focal_error,
            "of a camera whose calibration states no errors, share; its centre by as much of the focal length",
            {0.0, 0.5});
    v.field("distortion_error", distortion_error, "of k1 of a camera whose calibration states no errors", {0.0, 1.0});
    v.field("outlier_sigmas", outlier_sigmas, "a corner farther off than this has no weight", {2.0, 100.0});
    v.field("ambiguous_ratio", ambiguous_ratio,
            "ratio of the residuals of the runner-up and the best, below which they are not distinguished",
            {1.0, 100.0});
    v.field("most_iterations", most_iterations, "of the least squares", {1, 1000});
  }
};

struct BodyPose {
  Pose T_camera_marker;
  // Of (position, m; rotation vector, rad) along the camera's axes: (exp(δφ) R, t + δt).
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Matrix<double, 6, 6> noise = Eigen::Matrix<double, 6, 6>::Zero();  // the part that frames do not share
  double reprojection_px = 0.0;  // RMS over the corners used, of their distance
  double corner_px = 0.0;        // what corners are off by, each by itself, beside their own covariances
  double smooth_px = 0.0;        // and what moves neighbouring corners alike, both as the residual shows it
  bool converged = false;
  std::vector<bool> used;  // which of the tags seen: at least two corners have weight
  int tags_used = 0;
  int corners_used = 0;

  // The other way in which a plane can lie: a pose that is a minimum too.
  std::optional<Pose> runner_up;
  double runner_up_px = std::numeric_limits<double>::quiet_NaN();
  bool ambiguous = false;  // the runner-up's residual is close; `predicted` has chosen where it was given
};

// The pose of a rigid body of one or more tags that explains all the corners seen best, in the metric of their
// covariances, by Levenberg–Marquardt on SE(3) through the camera's distortion. It begins at each tag's two poses
// (Collins and Bartoli, 2014), and at `predicted`. Corners that don't fit the others (occluded, wrongly decoded, a
// second copy of a tag) lose their weight (one up to half of outlier_sigmas, then falling to nothing; the scale from
// the median). The covariance is of what corners are off by: their own noise, what the residual shows beside it, each
// corner by itself and neighbours alike, and what is wrong in all frames alike: the camera, the size of the print, the
// tags' places, a bend (docs/tracking.md). Where a plane could lie the other way as well, it holds the way to there by
// its likelihood. nullopt if no tag was seen or no pose puts the body in front of the camera. Throws Error for a tag
// that the body does not have.
std::optional<BodyPose> solve_body_pose(const CameraCalibration& camera, const std::vector<MarkerPlacement>& body,
                                        std::span<const SeenTag> seen, const std::optional<Pose>& predicted = {},
                                        const BodyPoseConfig& config = {});

}  // namespace asperity
