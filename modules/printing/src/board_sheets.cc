#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/printing/marker_sheets.h"
#include "page_parts.h"

namespace asperity {

namespace {

// A page on which a board of `columns` by `rows` squares fits, and where its first square begins.
struct BoardPage {
  PrintPage page;
  double left_mm = 0.0, top_mm = 0.0;
};

BoardPage board_page(int columns, int rows, double square_mm, Paper paper, const std::string& note) {
  for (const bool landscape : {columns > rows, columns <= rows}) {
    BoardPage out{ruled_page(paper, landscape, note)};
    const PageFrame frame = frame_of(out.page);
    if (columns * square_mm > frame.width_mm() || rows * square_mm > frame.height_mm()) continue;
    out.left_mm = frame.left_mm;
    out.top_mm = frame.top_mm;
    return out;
  }
  const PageFrame frame = frame_of(ruled_page(paper, columns > rows, note));
  throw Error(
      fmt::format("markers: a board of {} by {} squares of {} does not fit on the page; squares of {} do", columns,
                  rows, mm_text(square_mm),
                  mm_text(std::floor(10.0 * std::min(frame.width_mm() / columns, frame.height_mm() / rows)) / 10.0)));
}

void add_black_squares(BoardPage& board, int columns, int rows, double square_mm) {
  for (int row = 0; row < rows; ++row) {
    for (int column = row % 2; column < columns; column += 2) {
      board.page.black.push_back(
          {board.left_mm + column * square_mm, board.top_mm + row * square_mm, square_mm, square_mm});
    }
  }
}

void check_count(const char* what, int columns, int rows, int least) {
  if (std::min(columns, rows) < least || std::max(columns, rows) > 100) {
    throw Error(fmt::format("markers: a board of {} by {} {}; {} to 100 a side", columns, rows, what, least));
  }
}

}  // namespace

PrintPage layout_checkerboard(int columns, int rows, double square_m, Paper paper) {
  check_count("inner corners", columns, rows, 3);
  const double square_mm = checked_mm("a square", square_m);
  BoardPage board = board_page(
      columns + 1, rows + 1, square_mm, paper,
      fmt::format("asperity: checkerboard {}x{} inner corners, squares of {}", columns, rows, mm_text(square_mm)));
  add_black_squares(board, columns + 1, rows + 1, square_mm);
  return board.page;
}

PrintPage layout_charuco(const TagFamily& family, int columns, int rows, double square_m, double marker_m,
                         Paper paper) {
  check_count("squares", columns, rows, 3);
  const double square_mm = checked_mm("a square", square_m), marker_mm = checked_mm("a marker", marker_m);
  if (!(marker_mm < square_mm)) {
    throw Error(fmt::format("markers: a marker of {} is not smaller than its square of {}", mm_text(marker_mm),
                            mm_text(square_mm)));
  }
  BoardPage board = board_page(columns, rows, square_mm, paper,
                               fmt::format("asperity: ChArUco {}x{} squares of {}, {} of {}", columns, rows,
                                           mm_text(square_mm), printable(family.name, 40), mm_text(marker_mm)));
  add_black_squares(board, columns, rows, square_mm);
  const double inset_mm = 0.5 * (square_mm - marker_mm);
  int id = 0;
  for (int row = 0; row < rows; ++row) {
    for (int column = 1 - row % 2; column < columns; column += 2) {
      add_pattern(board.page, require_pattern(family, id++), board.left_mm + column * square_mm + inset_mm,
                  board.top_mm + row * square_mm + inset_mm, marker_mm);
    }
  }
  return board.page;
}

}  // namespace asperity
