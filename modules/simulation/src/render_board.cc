#include "asperity/simulation/render_board.h"

#include "camera_view.h"
#include "printed_figure.h"

namespace asperity {

std::vector<Eigen::Vector3d> board_corners_m(const SimulatedBoard& board) {
  const bool charuco = board.charuco;
  const int first = charuco ? 1 : 0;
  const int columns = board.columns - first;
  const int rows = board.rows - first;
  std::vector<Eigen::Vector3d> corners;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column)
      corners.emplace_back(board.square_m * (column + first), board.square_m * (row + first), 0.0);
  }
  return corners;
}

Eigen::Vector3d board_centre_m(const SimulatedBoard& board) {
  const double less = board.charuco ? 0.0 : 1.0;
  return 0.5 * board.square_m * Eigen::Vector3d(board.columns - less, board.rows - less, 0.0);
}

struct BoardRenderer::Impl {
  Impl(const SimulatedCameraConfig& config, const SimulatedBoard& board) : view(config), figure(print_board(board)) {}

  void draw(const Pose& T_world_board) {
    view.begin();
    view.draw(figure, T_world_board, T_world_board);
  }

  CameraView view;
  PrintedFigure figure;
};

BoardRenderer::BoardRenderer(const SimulatedCameraConfig& config, const SimulatedBoard& board)
    : impl_(std::make_unique<Impl>(config, board)) {}

BoardRenderer::~BoardRenderer() = default;

void BoardRenderer::render(const Pose& T_world_board, std::uint64_t frame, GrayImage& image) {
  impl_->draw(T_world_board);
  impl_->view.expose(frame, image);
}

void BoardRenderer::render_ideal(const Pose& T_world_board, IdealImage& image) {
  impl_->draw(T_world_board);
  impl_->view.ideal(image);
}

}  // namespace asperity
