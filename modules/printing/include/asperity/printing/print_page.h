#pragma once

#include <string>
#include <vector>

namespace asperity {

// A page to print: places and sizes in mm from its top left corner, x right, y down.

struct PrintRectangle {
  double left_mm = 0.0, top_mm = 0.0, width_mm = 0.0, height_mm = 0.0;
};

enum class LineStyle { kSolid, kDashed };

struct PrintLine {
  double x0_mm = 0.0, y0_mm = 0.0, x1_mm = 0.0, y1_mm = 0.0;
  LineStyle style = LineStyle::kSolid;
};

struct PrintText {
  double left_mm = 0.0, baseline_mm = 0.0, height_mm = 3.0;  // of the font
  std::string text;                                          // ASCII; other characters become '?'
};

struct PrintPage {
  double width_mm = 210.0, height_mm = 297.0;
  std::vector<PrintRectangle> black;  // filled, none over another
  std::vector<PrintLine> lines;       // 0.15 mm wide
  std::vector<PrintText> texts;
};

}  // namespace asperity
