#pragma once

#include <array>
#include <cstdint>

#include "asperity/recording/calibration.h"

namespace asperity {

// The camera that looks at the probe, its lens and its sensor. Sources of the values: docs/live-bench.md. Brightness
// is in counts of the 8-bit image, 0 to 255.
struct SimulatedCameraConfig {
  std::int64_t seed = 1;  // of the background and the noise
  int width = 640;
  int height = 480;
  double fx_px = 638.4;
  double fy_px = 640.9;
  double cx_px = 323.7;
  double cy_px = 235.8;
  std::array<double, 4> distortion{-0.25, 0.08, 6e-4, -4e-4};  // k1, k2, p1, p2

  double rate_Hz = 120.0;
  double exposure_s = 2e-3;

  double lens_sigma_px = 0.5;     // of the sharpest image
  double aperture_m = 2.1e-3;     // f = 6 mm at f/2.8
  double focus_distance_m = 0.4;  // what is nearer or farther is blurred by the aperture
  double vignetting = 0.25;       // of the light that the image's corner lacks
  double paper_counts = 200.0;    // white paper that faces the camera, in the image's middle
  double ink_counts = 20.0;
  double full_well_electrons = 10000.0;  // at 255 counts: shot noise
  double read_noise_counts = 0.8;
  bool clutter = true;               // false: an even grey background
  double background_counts = 110.0;  // without clutter
  double background_distance_m = 1.2;

  template <class V>
  void visit(V& v) {
    v.field("seed", seed, "of the background and the noise; the same seed gives the same bytes", {0.0, 9e15});
    v.field("width", width, "of the image, px", {16, 4096});
    v.field("height", height, "of the image, px", {16, 4096});
    v.field("fx_px", fx_px, "focal length along a row, px", {10.0, 1e5});
    v.field("fy_px", fy_px, "focal length along a column, px", {10.0, 1e5});
    v.field("cx_px", cx_px, "principal point, px", {-1e4, 1e4});
    v.field("cy_px", cy_px, "principal point, px", {-1e4, 1e4});
    v.field("distortion", distortion, "k1, k2, p1, p2 (camera_model.h)", {-1.0, 1.0});
    v.field("rate_Hz", rate_Hz, "frames a second, Hz", {1.0, 2000.0});
    v.field("exposure_s", exposure_s, "exposure of a frame, s; at most the frame's period", {0.0, 1.0});
    v.field("lens_sigma_px", lens_sigma_px, "standard deviation of a sharp point's image, px", {0.0, 10.0});
    v.field("aperture_m", aperture_m, "diameter of the lens's opening, m; 0 for a pinhole's depth of field",
            {0.0, 0.1});
    v.field("focus_distance_m", focus_distance_m, "distance of sharpest image, m", {0.01, 1e3});
    v.field("vignetting", vignetting, "part of the light that the image's corner lacks", {0.0, 0.9});
    v.field("paper_counts", paper_counts, "brightness of white paper", {1.0, 255.0});
    v.field("ink_counts", ink_counts, "brightness of black ink", {0.0, 254.0});
    v.field("full_well_electrons", full_well_electrons, "electrons of 255 counts: the shot noise", {10.0, 1e9});
    v.field("read_noise_counts", read_noise_counts, "noise of a dark pixel, counts rms", {0.0, 50.0});
    v.field("clutter", clutter, "a background of shapes and edges; else even");
    v.field("background_counts", background_counts, "brightness of the even background", {0.0, 255.0});
    v.field("background_distance_m", background_distance_m, "distance of the background, m: its blur", {0.01, 1e3});
  }
};

// The camera's exact calibration.
CameraCalibration camera_truth(const SimulatedCameraConfig& config);

// Standard deviation of the image of a point at `distance_m`: the lens's own and, in quadrature, a quarter of the
// diameter fx D |1/z − 1/z_focus| of the thin lens's circle of confusion (a disc's standard deviation along an axis).
double blur_sigma_px(const SimulatedCameraConfig& config, double distance_m);

}  // namespace asperity
