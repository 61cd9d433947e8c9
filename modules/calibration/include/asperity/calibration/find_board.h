#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "asperity/calibration/calibration_board.h"
#include "asperity/image/gray_image.h"

namespace asperity {

enum class CornerMethod { kSubPixel, kSectorBased };
inline constexpr std::array<std::string_view, 2> kCornerMethodNames{"sub_pixel", "sector_based"};

struct FindBoardConfig {
  CornerMethod method = CornerMethod::kSubPixel;
  int window_px = 8;
  double largest_megapixels = 64.0;

  template <class V>
  void visit(V& v) {
    v.choice("method", method, kCornerMethodNames,
             "checkerboard corners: found by OpenCV and refined with cornerSubPix, or findChessboardCornersSB alone");
    v.field("window_px", window_px, "largest half width of the window that a corner is refined in, px", {2, 50});
    v.field("largest_megapixels", largest_megapixels, "larger images are refused", {0.01, 1000.0});
  }
};

// The corners of `board` in `image` by OpenCV; nullopt if the board is not seen (a checkerboard must be seen whole, of
// a ChArUco board at least eight corners that are not all in one line). Corners are refined by the gradients around
// them (Förstner and Gülch, 1987) in a window of at most a third of the way to the next corner, so that it holds one
// corner only. `view.name` is left empty. Throws Error for a board that check_board refuses, an image without pixels or
// with more than the configured number, and if OpenCV fails.
std::optional<BoardView> find_board(const GrayImage& image, const CalibrationBoard& board,
                                    const FindBoardConfig& config = {});

}  // namespace asperity
