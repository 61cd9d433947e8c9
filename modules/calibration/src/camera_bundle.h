#pragma once

#include <array>
#include <span>
#include <vector>

#include "asperity/calibration/calibration_board.h"
#include "asperity/calibration/camera_fit.h"
#include "asperity/geometry/pose.h"

namespace asperity {

// Camera and poses at the least sum of squared distances between corners found and projected.
struct CameraBundle {
  CameraVector parameters = CameraVector::Zero();
  std::array<bool, kCameraParameters> free{};
  std::vector<Pose> T_camera_board;
  double sum_of_squares_px2 = 0.0;
  int iterations = 0;
  bool converged = false;

  // At the minimum: the information on the camera with all poses free, sum and by view, for corners of 1 px error;
  // rows and columns of parameters that are not free are zero. And each view's share of the gradient.
  CameraMatrix information = CameraMatrix::Zero();
  std::vector<CameraMatrix> view_information;
  std::vector<CameraVector> view_score;
};

// Levenberg–Marquardt from `bundle`'s parameters and poses, in place; the poses are eliminated view by view (Schur).
void refine_bundle(std::span<const BoardView* const> views, int most_iterations, CameraBundle& bundle);

// Sum of squared residuals of one view.
double view_sum_of_squares_px2(const BoardView& view, const CameraVector& parameters, const Pose& T_camera_board);

}  // namespace asperity
