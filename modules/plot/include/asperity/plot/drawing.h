#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace asperity {

// sRGB, and how much of what is below it hides.
struct Colour {
  std::uint8_t red = 0, green = 0, blue = 0;
  double opacity = 1.0;
};

struct DrawingPoint {
  double x_px = 0.0, y_px = 0.0;
};

// A line through points, or, where it is filled, the area that they bound.
struct DrawnPath {
  std::vector<DrawingPoint> points;
  Colour colour{};
  double width_px = 1.0;
  bool filled = false;
  bool dashed = false;
};

struct DrawnDisc {
  DrawingPoint centre;
  double radius_px = 2.0;
  Colour colour{};
};

enum class TextAnchor { kStart, kMiddle, kEnd };

// One line of text. `at` is on its baseline.
struct DrawnText {
  DrawingPoint at;
  std::string text;
  TextAnchor anchor = TextAnchor::kStart;
  double size_px = 13.0;
  bool bold = false;
  bool upwards = false;  // rotated, to be read from below to above
  Colour colour{0x33, 0x33, 0x33};
};

// Pixels in a box, row by row from its top; red, green and blue of each.
struct DrawnPixels {
  DrawingPoint corner;  // top left
  double width_px = 0.0, height_px = 0.0;
  std::size_t columns = 0, rows = 0;
  std::vector<std::uint8_t> rgb;
};

using DrawnShape = std::variant<DrawnPath, DrawnDisc, DrawnText, DrawnPixels>;

// Shapes on white, one over the other; x to the right, y downwards, 96 px an inch.
struct Drawing {
  double width_px = 0.0, height_px = 0.0;
  std::vector<DrawnShape> shapes;
};

}  // namespace asperity
