#pragma once

#include <string>

#include "asperity/printing/marker_sheets.h"

namespace asperity {

// The part of a page that rulers and what printers cannot reach leave.
struct PageFrame {
  double left_mm = 0.0, top_mm = 0.0, right_mm = 0.0, bottom_mm = 0.0;

  double width_mm() const { return right_mm - left_mm; }
  double height_mm() const { return bottom_mm - top_mm; }
};

// A page with its two rulers; `note` is printed beside the lower one.
PrintPage ruled_page(Paper paper, bool landscape, const std::string& note);
PageFrame frame_of(const PrintPage& page);

// The black cells of `pattern`, white margin included in its place, as few rectangles as runs of cells need. The black
// border is `size_mm` wide and its top left corner at (left, top).
void add_pattern(PrintPage& page, const TagPattern& pattern, double left_mm, double top_mm, double size_mm);

void add_outline(PrintPage& page, double left_mm, double top_mm, double width_mm, double height_mm);

// A length in mm as it was typed, to the nanometre. Throws Error, naming `what`, unless it is within 2 and 1000 mm.
double checked_mm(const char* what, double length_m);

// "46 mm", "22.5 mm".
std::string mm_text(double length_mm);

TagPattern require_pattern(const TagFamily& family, int id);

}  // namespace asperity
