#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "asperity/geometry/pose.h"
#include "asperity/image/gray_image.h"
#include "asperity/simulation/render_tags.h"
#include "asperity/simulation/simulated_camera_config.h"

namespace asperity {

// A flat board for the camera's calibration, with a white margin of one square. `columns` × `rows` counts the inner
// corners of a checkerboard (OpenCV's pattern size; its first square is black) and the squares of a ChArUco board,
// whose white squares hold tag36h11 markers in OpenCV's order, turned as OpenCV's DICT_APRILTAG_36h11 turns them.
struct SimulatedBoard {
  bool charuco = false;
  int columns = 9;
  int rows = 6;
  double square_m = 0.025;
  double marker_m = 0.018;  // ChArUco
};

// The inner corners in the board's frame, row by row, z = 0: x right, y down, z into the board; the origin is the first
// inner corner of a checkerboard, the outer corner of a ChArUco board's first square.
std::vector<Eigen::Vector3d> board_corners_m(const SimulatedBoard& board);
// The middle of the board.
Eigen::Vector3d board_centre_m(const SimulatedBoard& board);

// The camera's view of a stationary board: as render_tags.h.
class BoardRenderer {
 public:
  // Throws Error for a board without corners or with more than 60 squares along a side, or more markers than there are.
  BoardRenderer(const SimulatedCameraConfig& config, const SimulatedBoard& board);
  ~BoardRenderer();

  void render(const Pose& T_world_board, std::uint64_t frame, GrayImage& image);
  void render_ideal(const Pose& T_world_board, IdealImage& image);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace asperity
