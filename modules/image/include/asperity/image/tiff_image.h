#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace asperity {

// The image of a TIFF, one number a pixel, row by row from the top, as it is stored: no unit, no scaling.
struct TiffImage {
  std::size_t columns = 0;
  std::size_t rows = 0;
  int bits = 0;                // of a stored number: 8, 16, 32 or 64
  bool is_float = false;       // else a whole number
  bool is_signed = false;      // of whole numbers
  std::vector<double> values;  // nan where a float is nan
};

inline constexpr std::size_t kMostTiffPixels = std::size_t{1} << 27;

// Whether the bytes begin as a TIFF or BigTIFF does.
bool is_tiff(std::string_view bytes);

// Reads a TIFF of one sample a pixel: whole numbers of 8, 16 or 32 bits, signed or not, or floats of 32 or 64 bits, in
// strips or tiles, with any compression that libtiff knows. libtiff is in a library of our own that is loaded at the
// first call (ADR 17). Throws Error naming `name` for data that are damaged or cut off, colours, a palette, other kinds
// of numbers, an infinite one, more than kMostTiffPixels, further pages (smaller copies and masks of the first are
// passed over), and where the library is missing.
TiffImage parse_tiff(std::string_view bytes, const std::string& name);

}  // namespace asperity
