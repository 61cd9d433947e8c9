#include "asperity/calibration/calibration_board.h"

#include <fmt/format.h>

#include <cmath>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/vision/predefined_dictionary.h"

namespace asperity {

void check_board(const CalibrationBoard& board) {
  constexpr int kFewest = 3, kMost = 100;
  for (const int count : {board.inner_columns(), board.inner_rows()}) {
    if (count < kFewest || count > kMost) {
      throw Error(fmt::format("board {}x{}: {} inner corners a side, must be {} to {}", board.columns, board.rows,
                              count, kFewest, kMost));
    }
  }
  if (!(board.square_m > 0.0) || !std::isfinite(board.square_m)) {
    throw Error(fmt::format("board: square_m {} must be above 0", board.square_m));
  }
  if (board.kind != BoardKind::kCharuco) return;
  if (!(board.marker_m > 0.0 && board.marker_m < board.square_m)) {
    throw Error(
        fmt::format("board: marker_m {} must be above 0 and below the square's {}", board.marker_m, board.square_m));
  }
  const auto dictionary = find_predefined_dictionary(board.dictionary);
  if (!dictionary) {
    throw Error(
        fmt::format("board: dictionary '{}' is not known: DICT_4X4_50 to DICT_7X7_1000, DICT_ARUCO_ORIGINAL or "
                    "DICT_APRILTAG_16h5, _25h9, _36h10, _36h11",
                    printable(board.dictionary)));
  }
  const int markers = board.columns * board.rows / 2;
  if (markers > dictionary->markers) {
    throw Error(fmt::format("board {}x{}: needs {} markers, dictionary {} has {}", board.columns, board.rows, markers,
                            board.dictionary, dictionary->markers));
  }
}

}  // namespace asperity
