#pragma once

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "asperity/base/random.h"
#include "asperity/calibration/calibration_board.h"
#include "asperity/geometry/pose.h"
#include "asperity/image/gray_image.h"
#include "asperity/recording/camera_model.h"

namespace asperity::test {

struct RenderOptions {
  double blur_px = 0.6;  // standard deviation of the lens's blur, beside the pixel's own area
  double noise = 3.0;    // standard deviation, grey levels
  double dark = 40.0, bright = 200.0, ground = 130.0;
};

// What the camera sees of a printed texture on the plane z = 0 of the board's frame: `paint(x_m, y_m)` is the grey
// level there. Every pixel is the mean of 5 by 5 rays; the rays within a pixel are taken as linear, which errs by less
// than 1e-4 px.
template <class Paint>
GrayImage render_plane(Random& random, const CameraCalibration& camera, const Pose& T_camera_board, Paint paint,
                       const RenderOptions& options) {
  constexpr int kRays = 5;
  const int w = camera.width, h = camera.height;
  const Pose T_board_camera = T_camera_board.inverse();
  const Eigen::Vector3d eye = T_board_camera.translation_m;
  // Board coordinates at the pixels' corners.
  std::vector<Eigen::Vector2d> at(static_cast<std::size_t>((w + 1) * (h + 1)));
  for (int row = 0; row <= h; ++row) {
    for (int column = 0; column <= w; ++column) {
      const Eigen::Vector3d ray = T_board_camera.rotation * *unproject(camera, {column - 0.5, row - 0.5});
      at[static_cast<std::size_t>(row * (w + 1) + column)] = (eye - ray * (eye.z() / ray.z())).head<2>();
    }
  }
  cv::Mat light(h, w, CV_32F);
  for (int row = 0; row < h; ++row) {
    for (int column = 0; column < w; ++column) {
      const Eigen::Vector2d* corner = &at[static_cast<std::size_t>(row * (w + 1) + column)];
      double sum = 0.0;
      for (int i = 0; i < kRays; ++i) {
        const double b = (i + 0.5) / kRays;
        const Eigen::Vector2d left = corner[0] * (1.0 - b) + corner[w + 1] * b;
        const Eigen::Vector2d right = corner[1] * (1.0 - b) + corner[w + 2] * b;
        for (int j = 0; j < kRays; ++j) {
          const double a = (j + 0.5) / kRays;
          sum += paint(left.x() * (1.0 - a) + right.x() * a, left.y() * (1.0 - a) + right.y() * a);
        }
      }
      light.at<float>(row, column) = static_cast<float>(sum / (kRays * kRays));
    }
  }
  if (options.blur_px > 0.0) cv::GaussianBlur(light, light, {}, options.blur_px, options.blur_px, cv::BORDER_REPLICATE);
  GrayImage image{w, h, {}};
  for (int row = 0; row < h; ++row) {
    for (int column = 0; column < w; ++column) {
      const double level = light.at<float>(row, column) + options.noise * random.normal();
      image.pixels.push_back(static_cast<std::uint8_t>(std::clamp(std::round(level), 0.0, 255.0)));
    }
  }
  return image;
}

// A printed checkerboard with a white border of one square. Its frame has the origin in the first inner corner.
inline GrayImage render_checkerboard(Random& random, const CameraCalibration& camera, const CalibrationBoard& board,
                                     const Pose& T_camera_board, const RenderOptions& options = {}) {
  const auto paint = [&](double x_m, double y_m) {
    const double column = std::floor(x_m / board.square_m) + 1.0, row = std::floor(y_m / board.square_m) + 1.0;
    if (column < -1.0 || row < -1.0 || column > board.columns + 1.0 || row > board.rows + 1.0) return options.ground;
    if (column < 0.0 || row < 0.0 || column > board.columns || row > board.rows) return options.bright;
    return std::fmod(column + row, 2.0) == 0.0 ? options.dark : options.bright;
  };
  return render_plane(random, camera, T_camera_board, paint, options);
}

}  // namespace asperity::test
