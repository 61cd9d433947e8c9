#pragma once

#include <vector>

#include <Eigen/Core>

#include "asperity/recording/calibration.h"
#include "asperity/simulation/render_board.h"

namespace asperity {

// Black ink on a white card, all in one plane: closed outlines of straight sides, clockwise as seen (x right, y down).
struct PrintedFigure {
  struct Side {
    int from = 0;
    int to = 0;
  };
  std::vector<Eigen::Vector2d> vertices_m;
  std::vector<Side> ink;
  std::vector<Side> card;
  Eigen::Vector2d centre_m = Eigen::Vector2d::Zero();

  // The rectangle between two opposite corners, its sides no longer than `longest_m` (distortion bends long ones).
  void add_rectangle(std::vector<Side>& outline, const Eigen::Vector2d& low_m, const Eigen::Vector2d& high_m,
                     double longest_m);
};

// Tags in one plane whose white margins of one cell meet are printed on one card: one figure each, its frame that of
// the first of its tags. Throws Error for an unknown family or id, or a size that is not positive.
struct PlacedFigure {
  PrintedFigure figure;
  Pose T_marker_figure;
};
std::vector<PlacedFigure> print_tags(const std::vector<MarkerPlacement>& tags);

PrintedFigure print_board(const SimulatedBoard& board);

}  // namespace asperity
