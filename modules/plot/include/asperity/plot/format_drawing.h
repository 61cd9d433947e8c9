#pragma once

#include <array>
#include <string>
#include <string_view>

#include "asperity/plot/drawing.h"

namespace asperity {

enum class DrawingFormat { kSvg, kPng, kPdf };
inline constexpr std::array<std::string_view, 3> kDrawingFormatNames{"svg", "png", "pdf"};

// What each format's files begin with, as format_drawing() writes them.
inline constexpr std::string_view kSvgBegin = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<!-- asperity -->\n<svg ";
inline constexpr std::string_view kPdfMark = "\n%\xC1\xF3\xF0\xF2\n";  // the comment of four bytes in its second line

// The drawing as the content of a file; the same drawing gives the same bytes.
//   SVG    text stays text, in the reader's own sans-serif
//   PNG    `pixels_per_px` pixels for each px of the drawing, by Cairo
//   PDF    one page, 96 px an inch, by Cairo; without a date
// PNG and PDF have the shapes of letters that the machine's sans-serif has. Throws Error for a drawing of no size or of
// more than 32,767 pixels a side, and for PNG and PDF if libasperity_plot.so is missing (docs/adr/0016).
std::string format_drawing(const Drawing& drawing, DrawingFormat format, double pixels_per_px = 2.0);

}  // namespace asperity
