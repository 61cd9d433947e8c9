#include "printed_figure.h"

#include <apriltag/apriltag.h>
#include <apriltag/tag36h11.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>

#include <Eigen/Geometry>

#include "asperity/base/error.h"
#include "asperity/base/text.h"

namespace asperity {
namespace {

constexpr int kTagCells = 8;  // of tag36h11, its black border included

using Family = std::unique_ptr<apriltag_family_t, decltype(&tag36h11_destroy)>;

// Cells by row and column, true where there is ink.
using TagCells = std::array<std::array<bool, kTagCells>, kTagCells>;

TagCells tag_cells(int id) {
  const Family family(tag36h11_create(), &tag36h11_destroy);
  if (id < 0 || static_cast<std::uint32_t>(id) >= family->ncodes)
    throw Error(fmt::format("tag36h11 has no tag {}: 0 to {}", id, family->ncodes - 1));
  TagCells ink;
  for (auto& row : ink) row.fill(true);
  const std::uint64_t code = family->codes[id];
  for (std::uint32_t bit = 0; bit < family->nbits; ++bit) {
    const bool white = ((code >> (family->nbits - bit - 1)) & 1U) != 0U;
    ink[family->bit_y[bit]][family->bit_x[bit]] = !white;
  }
  return ink;
}

// The outline of all cells with ink, sides between two of them left out; its corners are each one vertex.
void add_cells(PrintedFigure& figure, const TagCells& ink, const Eigen::Isometry2d& T_figure_corner, double cell_m) {
  const int first = static_cast<int>(figure.vertices_m.size());
  for (int row = 0; row <= kTagCells; ++row) {
    for (int column = 0; column <= kTagCells; ++column)
      figure.vertices_m.emplace_back(T_figure_corner * (cell_m * Eigen::Vector2d(column, row)));
  }
  const auto vertex = [first](int column, int row) { return first + row * (kTagCells + 1) + column; };
  const auto has_ink = [&ink](int column, int row) {
    return column >= 0 && row >= 0 && column < kTagCells && row < kTagCells &&
           ink[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
  };
  for (int row = 0; row < kTagCells; ++row) {
    for (int column = 0; column < kTagCells; ++column) {
      if (!has_ink(column, row)) continue;
      if (!has_ink(column, row - 1)) figure.ink.push_back({vertex(column, row), vertex(column + 1, row)});
      if (!has_ink(column + 1, row)) figure.ink.push_back({vertex(column + 1, row), vertex(column + 1, row + 1)});
      if (!has_ink(column, row + 1)) figure.ink.push_back({vertex(column + 1, row + 1), vertex(column, row + 1)});
      if (!has_ink(column - 1, row)) figure.ink.push_back({vertex(column, row + 1), vertex(column, row)});
    }
  }
}

}  // namespace

void PrintedFigure::add_rectangle(std::vector<Side>& outline, const Eigen::Vector2d& low_m,
                                  const Eigen::Vector2d& high_m, double longest_m) {
  const std::array<Eigen::Vector2d, 4> corners{low_m, Eigen::Vector2d(high_m.x(), low_m.y()), high_m,
                                               Eigen::Vector2d(low_m.x(), high_m.y())};
  const int first = static_cast<int>(vertices_m.size());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector2d along_m = corners[(i + 1) % corners.size()] - corners[i];
    const int pieces = static_cast<int>(std::ceil(along_m.norm() / longest_m));
    for (int piece = 0; piece < pieces; ++piece) {
      const int here = static_cast<int>(vertices_m.size());
      vertices_m.emplace_back(corners[i] + static_cast<double>(piece) / pieces * along_m);
      outline.push_back({here, here + 1});
    }
  }
  outline.back().to = first;
}

std::vector<PlacedFigure> print_tags(const std::vector<MarkerPlacement>& tags) {
  std::vector<PlacedFigure> figures;
  std::vector<Eigen::AlignedBox2d> cards_m;
  for (const MarkerPlacement& tag : tags) {
    if (tag.family != "tag36h11") throw Error("tag family '" + printable(tag.family) + "' cannot be drawn: tag36h11");
    if (!(tag.size_m > 0.0) || !std::isfinite(tag.size_m))
      throw Error(fmt::format("tag {}: a size of {} m cannot be drawn", tag.id, tag.size_m));
    const double cell_m = tag.size_m / kTagCells;
    std::size_t i = 0;
    Eigen::Isometry2d T_figure_tag;
    Eigen::AlignedBox2d card_m;
    for (;; ++i) {
      if (i == figures.size()) {
        figures.push_back({{}, tag.T_marker_tag});
        cards_m.emplace_back();
      }
      const Pose T = figures[i].T_marker_figure.inverse() * tag.T_marker_tag;
      const Eigen::Matrix3d turn = T.rotation.toRotationMatrix();
      T_figure_tag = Eigen::Isometry2d(Eigen::Rotation2Dd(std::atan2(turn(1, 0), turn(0, 0))));
      T_figure_tag.pretranslate(T.translation_m.head<2>());
      const double reach_m = 0.5 * tag.size_m + cell_m;
      card_m.setEmpty();
      for (const double x : {-reach_m, reach_m}) {
        for (const double y : {-reach_m, reach_m}) card_m.extend(T_figure_tag * Eigen::Vector2d(x, y));
      }
      constexpr double kSamePlane = 1e-6;  // of the tag's size, and rad
      const bool same_plane = std::abs(T.translation_m.z()) < kSamePlane * tag.size_m &&
                              turn.col(2).head<2>().norm() < kSamePlane && turn(2, 2) > 0.0;
      if (cards_m[i].isEmpty() || (same_plane && cards_m[i].intersects(card_m))) break;
    }
    T_figure_tag.translate(Eigen::Vector2d::Constant(-0.5 * tag.size_m));
    add_cells(figures[i].figure, tag_cells(tag.id), T_figure_tag, cell_m);
    cards_m[i].extend(card_m);
  }
  for (std::size_t i = 0; i < figures.size(); ++i) {
    PrintedFigure& figure = figures[i].figure;
    figure.centre_m = cards_m[i].center();
    figure.add_rectangle(figure.card, cards_m[i].min(), cards_m[i].max(), 0.1 * cards_m[i].diagonal().norm());
  }
  return figures;
}

PrintedFigure print_board(const SimulatedBoard& board) {
  constexpr int kMostSquares = 60;
  constexpr int kTags = 587;
  const bool charuco = board.charuco;
  const int columns = board.columns + (charuco ? 0 : 1);
  const int rows = board.rows + (charuco ? 0 : 1);
  if (columns < 2 || rows < 2 || columns > kMostSquares || rows > kMostSquares)
    throw Error(fmt::format("a board of {}x{} squares cannot be drawn: 2 to {}", columns, rows, kMostSquares));
  if (charuco && columns * rows / 2 > kTags)
    throw Error(
        fmt::format("a ChArUco board of {}x{} squares has more markers than the {} of tag36h11", columns, rows, kTags));
  if (!(board.square_m > 0.0)) throw Error(fmt::format("a square of {} m cannot be drawn", board.square_m));
  if (charuco && !(board.marker_m > 0.0 && board.marker_m < board.square_m))
    throw Error(fmt::format("a marker of {} m does not fit a square of {} m", board.marker_m, board.square_m));
  const Eigen::Vector2d origin_m = charuco ? Eigen::Vector2d::Zero() : Eigen::Vector2d::Constant(-board.square_m);
  PrintedFigure figure;
  figure.centre_m = board_centre_m(board).head<2>();
  int marker = 0;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const Eigen::Vector2d low_m = origin_m + board.square_m * Eigen::Vector2d(column, row);
      const Eigen::Vector2d high_m = low_m + Eigen::Vector2d::Constant(board.square_m);
      if ((row + column) % 2 == 0) {
        figure.add_rectangle(figure.ink, low_m, high_m, board.square_m);
      } else if (charuco) {
        const double margin_m = 0.5 * (board.square_m - board.marker_m);
        const Eigen::Isometry2d T(Eigen::Translation2d(low_m + Eigen::Vector2d::Constant(margin_m)));
        TagCells cells = tag_cells(marker++);  // OpenCV's dictionary has the tags of this family upside down
        std::reverse(cells.begin(), cells.end());
        for (auto& cell_row : cells) std::reverse(cell_row.begin(), cell_row.end());
        add_cells(figure, cells, T, board.marker_m / kTagCells);
      }
    }
  }
  const Eigen::Vector2d margin_m = Eigen::Vector2d::Constant(board.square_m);
  figure.add_rectangle(figure.card, origin_m - margin_m,
                       origin_m + board.square_m * Eigen::Vector2d(columns, rows) + margin_m, board.square_m);
  return figure;
}

}  // namespace asperity
