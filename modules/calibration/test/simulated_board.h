#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "asperity/base/random.h"
#include "asperity/calibration/calibration_board.h"
#include "asperity/geometry/pose.h"
#include "asperity/recording/camera_model.h"

namespace asperity::test {

inline CameraCalibration true_camera() {
  return {640, 480, 612.0, 609.5, 322.7, 236.4, {-0.11, 0.06, 0.0008, -0.0011, 0.0}};
}

struct BoardViewOptions {
  double least_tilt_rad = 0.2, most_tilt_rad = 0.8;
  double nearest_m = 0.3, farthest_m = 0.6;
  double noise_px = 0.2;
  double view_bias_px = 0.0;         // a bend of the corners, different in every view
  Eigen::Vector2d spread{1.0, 1.0};  // of the board's centre over the image, from its centre
};

// A random pose in which the whole board is seen.
inline Pose random_board_pose(Random& random, const CameraCalibration& camera, const CalibrationBoard& board,
                              const BoardViewOptions& options) {
  const Eigen::Vector3d centre(0.5 * board.square_m * (board.inner_columns() - 1),
                               0.5 * board.square_m * (board.inner_rows() - 1), 0.0);
  for (;;) {
    const double azimuth = random.uniform(0.0, 6.283185307179586);
    const double tilt = random.uniform(options.least_tilt_rad, options.most_tilt_rad);
    Pose pose;
    pose.rotation = exp_rotation(tilt * Eigen::Vector3d(std::cos(azimuth), std::sin(azimuth), 0.0)) *
                    exp_rotation({0.0, 0.0, random.uniform(-0.4, 0.4)});
    const double z = random.uniform(options.nearest_m, options.farthest_m);
    const double u = camera.cx + 0.5 * options.spread.x() * camera.width * random.uniform(-1.0, 1.0);
    const double v = camera.cy + 0.5 * options.spread.y() * camera.height * random.uniform(-1.0, 1.0);
    pose.translation_m =
        Eigen::Vector3d((u - camera.cx) / camera.fx * z, (v - camera.cy) / camera.fy * z, z) - pose.rotation * centre;
    bool inside = true;
    // One square of margin: the outer squares are seen too.
    for (int row : {-1, board.inner_rows()}) {
      for (int column : {-1, board.inner_columns()}) {
        const auto pixel = project(camera, pose * Eigen::Vector3d(board.square_m * column, board.square_m * row, 0.0));
        inside = inside && pixel && pixel->x() > 4.0 && pixel->y() > 4.0 && pixel->x() < camera.width - 5.0 &&
                 pixel->y() < camera.height - 5.0;
      }
    }
    if (inside) return pose;
  }
}

// The corners as a perfect finder with Gaussian errors would see them.
inline BoardView simulated_view(Random& random, const CameraCalibration& camera, const CalibrationBoard& board,
                                const Pose& T_camera_board, const BoardViewOptions& options) {
  BoardView view;
  Eigen::Matrix<double, 2, 3> bend;
  for (int k = 0; k < 6; ++k) bend(k / 3, k % 3) = options.view_bias_px * random.normal();
  for (int row = 0; row < board.inner_rows(); ++row) {
    for (int column = 0; column < board.inner_columns(); ++column) {
      const Eigen::Vector3d p(board.square_m * column, board.square_m * row, 0.0);
      const double a = 2.0 * column / (board.inner_columns() - 1) - 1.0, b = 2.0 * row / (board.inner_rows() - 1) - 1.0;
      const Eigen::Vector2d error = options.noise_px * Eigen::Vector2d(random.normal(), random.normal()) +
                                    bend * Eigen::Vector3d(a * a - 0.5, b * b - 0.5, a * b);
      view.p_board_m.push_back(p);
      view.corner_px.push_back(*project(camera, T_camera_board * p) + error);
    }
  }
  return view;
}

inline std::vector<BoardView> simulated_views(Random& random, const CameraCalibration& camera,
                                              const CalibrationBoard& board, int count,
                                              const BoardViewOptions& options = {}) {
  std::vector<BoardView> views;
  for (int i = 0; i < count; ++i) {
    views.push_back(simulated_view(random, camera, board, random_board_pose(random, camera, board, options), options));
    views.back().name = "view " + std::to_string(i);
  }
  return views;
}

}  // namespace asperity::test
