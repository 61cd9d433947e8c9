#include "asperity/calibration/find_board.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/vision/predefined_dictionary.h"
#include "asperity/vision/vision.h"

namespace asperity {

namespace {

constexpr std::size_t kFewestCharucoCorners = 8;
constexpr double kCheckerboardClear = 1.0 / 3.0;  // of the way to the next corner

// The corners as cells of the board's grid, column first.
struct Corners {
  std::vector<Eigen::Vector2f> pixel;
  std::vector<Eigen::Vector2i> cell;
};

// The shortest way from a corner to its neighbour in the grid.
double least_spacing_px(const Corners& corners) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < corners.pixel.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if ((corners.cell[i] - corners.cell[j]).lpNorm<1>() == 1)
        least = std::min(least, (corners.pixel[i] - corners.pixel[j]).cast<double>().norm());
    }
  }
  return least;
}

// Refines the corners in windows whose half width is at most `clear_share` of the way to the next corner, so that
// nothing else printed lies in them. False if the squares are too small for that.
bool refine_board_corners(const GrayImage& image, const FindBoardConfig& config, double clear_share, Corners& corners) {
  constexpr int kSmallestWindow_px = 2;
  const double spacing_px = least_spacing_px(corners);
  const int window = std::isfinite(spacing_px) ? std::min(config.window_px, static_cast<int>(clear_share * spacing_px))
                                               : kSmallestWindow_px;
  if (window < kSmallestWindow_px) return false;
  vision().refine_corners(image, window, corners.pixel);
  return true;
}

std::optional<Corners> find_checkerboard(const GrayImage& image, const CalibrationBoard& board,
                                         const FindBoardConfig& config) {
  const std::size_t count = static_cast<std::size_t>(board.columns) * static_cast<std::size_t>(board.rows);
  Corners out;
  if (config.method == CornerMethod::kSubPixel) {
    out.pixel = vision().find_checkerboard(image, board.columns, board.rows, false);
  }
  // The sector-based finder still sees boards that blur hides from the classic one.
  if (out.pixel.empty()) out.pixel = vision().find_checkerboard(image, board.columns, board.rows, true);
  if (out.pixel.size() != count) return std::nullopt;
  for (int row = 0; row < board.rows; ++row) {
    for (int column = 0; column < board.columns; ++column) out.cell.emplace_back(column, row);
  }
  if (config.method == CornerMethod::kSubPixel && !refine_board_corners(image, config, kCheckerboardClear, out))
    return std::nullopt;
  return out;
}

std::optional<Corners> find_charuco(const GrayImage& image, const CalibrationBoard& board,
                                    const FindBoardConfig& config) {
  const int dictionary = find_predefined_dictionary(board.dictionary)->opencv_id;
  CharucoCorners found = vision().find_charuco(image, {board.columns, board.rows, static_cast<float>(board.square_m),
                                                       static_cast<float>(board.marker_m), dictionary});
  if (found.id.size() < kFewestCharucoCorners) return std::nullopt;
  Corners out;
  out.pixel = std::move(found.corner_px);
  int columns = 0, rows = 0;
  std::vector<bool> column_seen(static_cast<std::size_t>(board.inner_columns()));
  std::vector<bool> row_seen(static_cast<std::size_t>(board.inner_rows()));
  for (const int id : found.id) {
    const Eigen::Vector2i cell(id % board.inner_columns(), id / board.inner_columns());
    out.cell.push_back(cell);
    auto column = column_seen[static_cast<std::size_t>(cell.x())];
    auto row = row_seen[static_cast<std::size_t>(cell.y())];
    columns += !column;
    rows += !row;
    column = row = true;
  }
  if (columns < 2 || rows < 2) return std::nullopt;
  // The markers' own corners are the nearest: their distance along a side of the square.
  const double clear_share = 0.5 * (1.0 - board.marker_m / board.square_m);
  if (!refine_board_corners(image, config, clear_share, out)) return std::nullopt;
  return out;
}

}  // namespace

std::optional<BoardView> find_board(const GrayImage& image, const CalibrationBoard& board,
                                    const FindBoardConfig& config) {
  check_board(board);
  const double pixels = static_cast<double>(image.width) * static_cast<double>(image.height);
  if (image.width <= 0 || image.height <= 0 || static_cast<double>(image.pixels.size()) != pixels ||
      pixels > config.largest_megapixels * 1e6) {
    throw Error(fmt::format("find board: an image of {}x{} px, must be above 0 and at most {} megapixels", image.width,
                            image.height, config.largest_megapixels));
  }
  try {
    const auto corners = board.kind == BoardKind::kCharuco ? find_charuco(image, board, config)
                                                           : find_checkerboard(image, board, config);
    if (!corners) return std::nullopt;
    BoardView view;
    for (std::size_t i = 0; i < corners->pixel.size(); ++i) {
      if (!corners->pixel[i].allFinite()) return std::nullopt;
      view.corner_px.push_back(corners->pixel[i].cast<double>());
      view.p_board_m.emplace_back(board.square_m * corners->cell[i].x(), board.square_m * corners->cell[i].y(), 0.0);
    }
    return view;
  } catch (const VisionError& error) {
    throw Error(fmt::format("find board: OpenCV: {}", error.what()));
  }
}

}  // namespace asperity
