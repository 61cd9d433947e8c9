#include "page_parts.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "asperity/base/error.h"
#include "asperity/base/text.h"

namespace asperity {

namespace {

constexpr double kMargin_mm = 8.0;       // what a printer may not reach, and some more
constexpr double kRulerStrip_mm = 12.0;  // beside the left and the lower margin
constexpr int kRuler_mm = 100;

double tick_mm(int at_mm) { return at_mm % 10 == 0 ? 5.0 : at_mm % 5 == 0 ? 3.5 : 2.0; }

constexpr double kSmallestPage_mm = 2.0, kLargestPage_mm = 1000.0;

}  // namespace

double checked_mm(const char* what, double length_m) {
  const double length_mm = std::round(length_m * 1e9) / 1e6;
  if (!(length_mm >= kSmallestPage_mm && length_mm <= kLargestPage_mm)) {
    throw Error(fmt::format("markers: {} of {} is not within {} and {} mm", what, mm_text(length_m * 1e3),
                            kSmallestPage_mm, kLargestPage_mm));
  }
  return length_mm;
}

std::string mm_text(double length_mm) { return fmt::format("{:.6g} mm", length_mm); }

TagPattern require_pattern(const TagFamily& family, int id) {
  const auto pattern = family.pattern(id);
  if (!pattern) throw Error(fmt::format("markers: the family {} has no tag {}", printable(family.name), id));
  return *pattern;
}

PageFrame frame_of(const PrintPage& page) {
  return {kMargin_mm + kRulerStrip_mm, kMargin_mm, page.width_mm - kMargin_mm,
          page.height_mm - kMargin_mm - kRulerStrip_mm};
}

PrintPage ruled_page(Paper paper, bool landscape, const std::string& note) {
  PrintPage page;
  if (paper == Paper::kLetter) {
    page.width_mm = 215.9;
    page.height_mm = 279.4;
  }
  if (landscape) std::swap(page.width_mm, page.height_mm);
  const PageFrame frame = frame_of(page);
  const double foot_mm = page.height_mm - kMargin_mm, side_mm = kMargin_mm;
  page.lines.push_back({frame.left_mm, foot_mm, frame.left_mm + kRuler_mm, foot_mm});
  page.lines.push_back({side_mm, frame.top_mm, side_mm, frame.top_mm + kRuler_mm});
  for (int at = 0; at <= kRuler_mm; ++at) {
    page.lines.push_back({frame.left_mm + at, foot_mm - tick_mm(at), frame.left_mm + at, foot_mm});
    page.lines.push_back({side_mm, frame.top_mm + at, side_mm + tick_mm(at), frame.top_mm + at});
  }
  page.texts.push_back({frame.left_mm, foot_mm - 6.5, 2.8, "100 mm exactly, on both rulers? Else print at 100 %."});
  page.texts.push_back({frame.left_mm + kRuler_mm + 4.0, foot_mm, 2.8, note});
  return page;
}

void add_pattern(PrintPage& page, const TagPattern& pattern, double left_mm, double top_mm, double size_mm) {
  const double cell_mm = size_mm / pattern.border_cells();
  const auto edge = [&](double begin_mm, int cell) { return begin_mm + cell_mm * (cell - pattern.margin); };
  std::vector<bool> drawn(pattern.white.size(), false);
  const auto black = [&](int column, int row) {
    return !pattern.is_white(column, row) && !drawn[static_cast<std::size_t>(row * pattern.cells + column)];
  };
  for (int row = 0; row < pattern.cells; ++row) {
    for (int column = 0; column < pattern.cells; ++column) {
      if (!black(column, row)) continue;
      int right = column, bottom = row;
      while (right < pattern.cells && black(right, row)) ++right;
      const auto row_is_black = [&](int at) {
        for (int i = column; i < right; ++i) {
          if (!black(i, at)) return false;
        }
        return true;
      };
      while (bottom < pattern.cells && row_is_black(bottom)) ++bottom;
      for (int y = row; y < bottom; ++y) {
        for (int x = column; x < right; ++x) drawn[static_cast<std::size_t>(y * pattern.cells + x)] = true;
      }
      page.black.push_back(
          {edge(left_mm, column), edge(top_mm, row), cell_mm * (right - column), cell_mm * (bottom - row)});
    }
  }
}

void add_outline(PrintPage& page, double left_mm, double top_mm, double width_mm, double height_mm) {
  const double right_mm = left_mm + width_mm, bottom_mm = top_mm + height_mm;
  page.lines.push_back({left_mm, top_mm, right_mm, top_mm});
  page.lines.push_back({right_mm, top_mm, right_mm, bottom_mm});
  page.lines.push_back({right_mm, bottom_mm, left_mm, bottom_mm});
  page.lines.push_back({left_mm, bottom_mm, left_mm, top_mm});
}

}  // namespace asperity
