#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

namespace asperity {

enum class BoardKind { kCheckerboard, kCharuco };
inline constexpr std::array<std::string_view, 2> kBoardKindNames{"checkerboard", "charuco"};

// A flat board with a pattern of squares. A checkerboard is counted in inner corners, as OpenCV counts it (9x6: ten
// squares by seven); a ChArUco board in squares.
struct CalibrationBoard {
  BoardKind kind = BoardKind::kCheckerboard;
  int columns = 9;
  int rows = 6;
  double square_m = 0.025;
  double marker_m = 0.0;                   // ChArUco: the black marker's edge
  std::string dictionary = "DICT_4X4_50";  // ChArUco

  int inner_columns() const { return kind == BoardKind::kCharuco ? columns - 1 : columns; }
  int inner_rows() const { return kind == BoardKind::kCharuco ? rows - 1 : rows; }
};

// The board's inner corners as they were found in one image.
struct BoardView {
  std::string name;                        // of the image, for messages
  std::vector<Eigen::Vector2d> corner_px;  // the centre of the first pixel is (0, 0)
  std::vector<Eigen::Vector3d> p_board_m;  // where those corners are on the board, z = 0
};

// Throws Error naming the field unless the board has 3 to 100 inner corners a side, a positive square and, for
// ChArUco, a smaller marker and a dictionary that OpenCV knows.
void check_board(const CalibrationBoard& board);

}  // namespace asperity
