#pragma once

#include <cstdint>
#include <vector>

namespace asperity {

// A tag as it is printed: `cells` by `cells` squares, row by row from the top left as it is seen upright, 1 for white.
// The black border whose outer edge is the tag's size begins `margin` cells inside.
struct TagPattern {
  int cells = 0;
  int margin = 0;
  std::vector<std::uint8_t> white;

  bool is_white(int column, int row) const { return white[static_cast<std::size_t>(row * cells + column)] != 0; }
  int border_cells() const { return cells - 2 * margin; }
};

}  // namespace asperity
