#pragma once

#include <array>
#include <span>
#include <string_view>

#include "asperity/calibration/calibration_board.h"
#include "asperity/calibration/camera_fit.h"

namespace asperity {

enum class ThirdRadialTerm { kAuto, kZero, kFree };
inline constexpr std::array<std::string_view, 3> kThirdRadialTermNames{"auto", "zero", "free"};

struct CameraFitConfig {
  ThirdRadialTerm k3 = ThirdRadialTerm::kAuto;
  int least_views = 8;
  double least_tilt_rad = 0.17;
  double least_coverage = 0.25;
  double good_coverage = 0.5;
  double largest_focal_error = 0.02;
  double good_focal_error = 0.005;
  double good_rms_px = 1.0;
  double outlier_rms = 3.0;
  int most_iterations = 200;

  template <class V>
  void visit(V& v) {
    v.choice("k3", k3, kThirdRadialTermNames,
             "the third radial term: fitted where the data ask for it, zero, or fitted");
    v.field("least_views", least_views, "images with the board that are needed", {4, 10000});
    v.field("least_tilt_rad", least_tilt_rad, "two views at least must be tilted by more, rad", {0.0, 1.5});
    v.field("least_coverage", least_coverage, "share of the image that the corners' hull must cover", {0.0, 1.0});
    v.field("good_coverage", good_coverage, "share of the image below which the verdict warns", {0.0, 1.0});
    v.field("largest_focal_error", largest_focal_error,
            "standard error of fx and fy above which the fit is refused, share", {0.0, 1.0});
    v.field("good_focal_error", good_focal_error, "standard error of fx and fy above which the verdict warns, share",
            {0.0, 1.0});
    v.field("good_rms_px", good_rms_px, "RMS residual above which the verdict warns, px", {0.0, 100.0});
    v.field("outlier_rms", outlier_rms, "a view is left out above this multiple of the median RMS of all views",
            {1.5, 1000.0});
    v.field("most_iterations", most_iterations, "of the least-squares fit", {1, 100000});
  }
};

// The intrinsic parameters of a camera from views of a flat board (Zhang, 2000; the thesis's §3.5 uses Bouguet's
// toolbox for the same): least squares of the corners' distances in the image over the camera and the board's pose in
// each view, from OpenCV's start values. The model is the one of camera_model.h. Standard errors are those of the
// camera's parameters with all poses free, from the residuals' own variance; where views disagree by more than
// the corners within them do, they are larger by that (docs/calibration-optics.md). `width` and
// `height` are the images', px.
// Throws Error, saying what to do about it, for too few views, a view with fewer than eight corners, a board that was
// always frontal (the focal length is not determined) or always in one part of the image.
CameraFit calibrate_camera(std::span<const BoardView> views, int width, int height, const CameraFitConfig& config = {});

}  // namespace asperity
