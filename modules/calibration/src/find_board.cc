#include "asperity/calibration/find_board.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/aruco/charuco.hpp>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "asperity/base/error.h"
#include "charuco_dictionary.h"

namespace asperity {

namespace {

constexpr std::size_t kFewestCharucoCorners = 8;
constexpr double kCheckerboardClear = 1.0 / 3.0;  // of the way to the next corner

// The corners as cells of the board's grid, column first.
struct Corners {
  std::vector<cv::Point2f> pixel;
  std::vector<cv::Point> cell;
};

// The shortest way from a corner to its neighbour in the grid.
double least_spacing_px(const Corners& corners) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < corners.pixel.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const cv::Point step = corners.cell[i] - corners.cell[j];
      if (std::abs(step.x) + std::abs(step.y) == 1)
        least = std::min(least, cv::norm(corners.pixel[i] - corners.pixel[j]));
    }
  }
  return least;
}

// Refines the corners in windows whose half width is at most `clear_share` of the way to the next corner, so that
// nothing else printed lies in them. False if the squares are too small for that.
bool refine(const cv::Mat& image, const FindBoardConfig& config, double clear_share, Corners& corners) {
  constexpr int kSmallestWindow_px = 2;
  const double spacing_px = least_spacing_px(corners);
  const int window = std::isfinite(spacing_px) ? std::min(config.window_px, static_cast<int>(clear_share * spacing_px))
                                               : kSmallestWindow_px;
  if (window < kSmallestWindow_px) return false;
  const cv::TermCriteria stop(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 100, 1e-4);
  cv::cornerSubPix(image, corners.pixel, {window, window}, {-1, -1}, stop);
  return true;
}

std::optional<Corners> find_checkerboard(const cv::Mat& image, const CalibrationBoard& board,
                                         const FindBoardConfig& config) {
  const cv::Size size(board.columns, board.rows);
  Corners out;
  const bool classic =
      config.method == CornerMethod::kSubPixel &&
      cv::findChessboardCorners(image, size, out.pixel,
                                cv::CALIB_CB_ADAPTIVE_THRESH | cv::CALIB_CB_NORMALIZE_IMAGE | cv::CALIB_CB_FAST_CHECK);
  // The sector-based finder still sees boards that blur hides from the classic one.
  if (!classic &&
      !cv::findChessboardCornersSB(image, size, out.pixel, cv::CALIB_CB_NORMALIZE_IMAGE | cv::CALIB_CB_ACCURACY)) {
    return std::nullopt;
  }
  if (out.pixel.size() != static_cast<std::size_t>(size.area())) return std::nullopt;
  for (int row = 0; row < size.height; ++row) {
    for (int column = 0; column < size.width; ++column) out.cell.emplace_back(column, row);
  }
  if (config.method == CornerMethod::kSubPixel && !refine(image, config, kCheckerboardClear, out)) return std::nullopt;
  return out;
}

std::optional<Corners> find_charuco(const cv::Mat& image, const CalibrationBoard& board,
                                    const FindBoardConfig& config) {
  const auto dictionary = cv::aruco::getPredefinedDictionary(find_charuco_dictionary(board.dictionary)->opencv_id);
  const auto pattern = cv::aruco::CharucoBoard::create(board.columns, board.rows, static_cast<float>(board.square_m),
                                                       static_cast<float>(board.marker_m), dictionary);
  std::vector<std::vector<cv::Point2f>> markers;
  std::vector<int> marker_ids, corner_ids;
  cv::aruco::detectMarkers(image, dictionary, markers, marker_ids);
  Corners out;
  if (marker_ids.empty()) return std::nullopt;
  cv::aruco::interpolateCornersCharuco(markers, marker_ids, image, pattern, out.pixel, corner_ids);
  if (corner_ids.size() < kFewestCharucoCorners) return std::nullopt;
  int columns = 0, rows = 0;
  std::vector<bool> column_seen(static_cast<std::size_t>(board.inner_columns()));
  std::vector<bool> row_seen(static_cast<std::size_t>(board.inner_rows()));
  for (const int id : corner_ids) {
    const cv::Point cell(id % board.inner_columns(), id / board.inner_columns());
    out.cell.push_back(cell);
    auto column = column_seen[static_cast<std::size_t>(cell.x)];
    auto row = row_seen[static_cast<std::size_t>(cell.y)];
    columns += !column;
    rows += !row;
    column = row = true;
  }
  if (columns < 2 || rows < 2) return std::nullopt;
  // The markers' own corners are the nearest: their distance along a side of the square.
  const double clear_share = 0.5 * (1.0 - board.marker_m / board.square_m);
  if (!refine(image, config, clear_share, out)) return std::nullopt;
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
    // A copy: OpenCV has no view of constant pixels.
    cv::Mat pixels_of_image(image.height, image.width, CV_8UC1);
    std::copy(image.pixels.begin(), image.pixels.end(), pixels_of_image.data);
    const auto corners = board.kind == BoardKind::kCharuco ? find_charuco(pixels_of_image, board, config)
                                                           : find_checkerboard(pixels_of_image, board, config);
    if (!corners) return std::nullopt;
    BoardView view;
    for (std::size_t i = 0; i < corners->pixel.size(); ++i) {
      const cv::Point2f pixel = corners->pixel[i];
      if (!std::isfinite(pixel.x) || !std::isfinite(pixel.y)) return std::nullopt;
      view.corner_px.emplace_back(pixel.x, pixel.y);
      view.p_board_m.emplace_back(board.square_m * corners->cell[i].x, board.square_m * corners->cell[i].y, 0.0);
    }
    return view;
  } catch (const cv::Exception& error) {
    throw Error(fmt::format("find board: OpenCV: {}", error.what()));
  }
}

}  // namespace asperity
