#pragma once

#include <optional>

#include <Eigen/Core>

#include "asperity/image/gray_image.h"
#include "asperity/recording/calibration.h"
#include "asperity/tracking/tag_pattern.h"

namespace asperity {

struct RefineCornersConfig {
  bool enabled = true;
  int most_pixels = 2000;  // of one tag that are compared; more are thinned out
  int most_iterations = 12;
  double largest_move_px = 3.0;   // a corner that would move farther stays where the detector saw it
  double model_sigma_px = 0.003;  // error of each coordinate that the model leaves out, in addition to the noise

  template <class V>
  void visit(V& v) {
    v.field("enabled", enabled, "compare the image with the tag's picture");
    v.field("most_pixels", most_pixels, "of one tag that are compared; more are thinned out", {200, 1'000'000});
    v.field("most_iterations", most_iterations, "of the least squares", {2, 100});
    v.field("largest_move_px", largest_move_px, "a corner that would move farther stays where the detector saw it",
            {0.1, 100.0});
    v.field("model_sigma_px", model_sigma_px,
            "error of each coordinate that the model leaves out, in addition to the noise", {0.0, 10.0});
  }
};

// How a camera spreads a point, pixel, defocus and motion together: a Gaussian's covariance in the image.
struct PointSpread {
  double xx_px2 = 0.4;
  double xy_px2 = 0.0;
  double yy_px2 = 0.4;
};

struct RefinedCorners {
  Eigen::Matrix<double, 2, 4> corners_px;
  Eigen::Matrix<double, 8, 8> covariance_px2;
  PointSpread spread;
  double black = 0.0, white = 0.0;  // grey levels in the tag's middle
  double residual = 0.0;            // grey levels
  int pixels = 0;
  int iterations = 0;
};

// The corners of a tag for which its picture, seen through the camera, fits the image best: all edges of the
// tag count, inside as well as the border's, dark to light as well as light to dark, so that a camera that lets
// white bleed into black moves none of them. The picture is mapped by a homography and the lens distortion, spread by a
// Gaussian (PointSpread, fitted) and shaded by two planes (fitted):
//   I(p) = min(I_max, β(x) + γ(x) (B + e |∇B|)(x)),  B = P ∗ G_S,  x = H⁻¹(undistort(p)),  β and γ linear in x,
// where e, in px, is how far white has grown into black or black into white: ink that has run, a camera that is not
// linear or bleeds. Levenberg–Marquardt on H, S, β, γ and e over the pixels at edges; a pixel that does not fit loses
// its weight, one that is saturated has none. The covariance is that of the least squares with the residual's own
// variance. nullopt where the picture does not fit, or the tag is too small or cut by the image's border. `corners_px`
// within about a cell of the truth.
std::optional<RefinedCorners> refine_corners(const GrayImage& image, const CameraCalibration& camera,
                                             const TagPattern& pattern, const Eigen::Matrix<double, 2, 4>& corners_px,
                                             const PointSpread& spread = {}, const RefineCornersConfig& config = {});

}  // namespace asperity
