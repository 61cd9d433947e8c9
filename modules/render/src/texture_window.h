#pragma once

#include <cstddef>

#include "asperity/texture/texture.h"

namespace asperity {

// The part of its plane in which a height field shows all that it has.
struct TextureWindow {
  double x_m = 0.0;
  double y_m = 0.0;
  double length_m = 0.01;
  double width_m = 0.01;
  std::size_t columns = 128;  // cells: of its grid, or four to the shortest wave
  std::size_t rows = 128;
};

// A period, or an image or a grid that does not repeat, of either at most `most_cells` cells in each direction.
TextureWindow texture_window(const TextureModel& model, std::size_t most_cells);

}  // namespace asperity
