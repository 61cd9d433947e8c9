#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace asperity {

// Heights on a grid, row by row; one row: a profile.
struct X3pGrid {
  std::size_t columns = 0;
  std::size_t rows = 1;
  double x_spacing_m = 0.0;
  double y_spacing_m = 0.0;  // without meaning for a profile
  std::vector<double> height_m;
  std::string note{};  // for people: what of it was measured. A comment in main.xml
};

// Heights as an X3P file (ISO 25178-72): a zip archive of main.xml, the heights as doubles in metres, nan where
// missing, and their MD5 sums. The archive is stored uncompressed and without dates, so that the same heights give the
// same bytes. Throws Error for a grid of other than columns · rows heights, an infinite height, a spacing that is not
// positive, or more than 2^27 heights.
std::string format_x3p(const X3pGrid& grid);

}  // namespace asperity
