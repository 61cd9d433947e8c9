#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/plot/colour_map.h"
#include "plot_box.h"

namespace asperity {

namespace {

constexpr Colour kMissing{0xd0, 0xd0, 0xd0};
constexpr std::size_t kMostPixels = 1200;  // a side
constexpr double kBar_px = 16.0, kBarLabels_px = 128.0;
constexpr double kTallestMap_px = 700.0;
constexpr double kOutside = 0.005;  // of the values below the bar, and above it

struct ColourRange {
  double low = 0.0, high = 1.0;
  bool cut = false;
};

ColourRange range_of(std::vector<double> values) {
  std::erase_if(values, [](double v) { return !std::isfinite(v); });
  if (values.empty()) return {};
  const auto at = [&](double share) {
    const auto place = values.begin() + std::lround(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), place, values.end());
    return *place;
  };
  const double lowest = at(0.0), highest = at(1.0);
  ColourRange out{at(kOutside), at(1.0 - kOutside)};
  if (!(out.high > out.low)) out = {lowest, highest};
  if (!(out.high > out.low))
    return {lowest - 0.5 * std::max(1e-300, std::abs(lowest)), lowest + 0.5 * std::max(1e-300, std::abs(lowest)),
            false};
  out.cut = out.low > lowest || out.high < highest;
  return out;
}

// The mean of the finite values of a block; nan if there is none.
double block_mean(const FigureMap& map, std::size_t row, std::size_t column, std::size_t block) {
  double sum = 0.0, count = 0.0;
  for (std::size_t r = row; r < std::min(map.rows, row + block); ++r) {
    for (std::size_t c = column; c < std::min(map.columns, column + block); ++c) {
      const double v = map.value[r * map.columns + c];
      if (!std::isfinite(v)) continue;
      sum += v;
      count += 1.0;
    }
  }
  return count > 0.0 ? sum / count : std::numeric_limits<double>::quiet_NaN();
}

void put(std::vector<std::uint8_t>& rgb, const Colour& c) { rgb.insert(rgb.end(), {c.red, c.green, c.blue}); }

DrawnPixels pixels_of(const FigureMap& map, const ColourRange& range) {
  const std::size_t block = (std::max(map.columns, map.rows) + kMostPixels - 1) / kMostPixels;
  DrawnPixels out;
  out.columns = (map.columns + block - 1) / block;
  out.rows = (map.rows + block - 1) / block;
  for (std::size_t r = out.rows; r-- > 0;) {
    for (std::size_t c = 0; c < out.columns; ++c) {
      const double v = block_mean(map, r * block, c * block, block);
      put(out.rgb, std::isfinite(v) ? viridis((v - range.low) / (range.high - range.low)) : kMissing);
    }
  }
  return out;
}

void draw_bar(Drawing& drawing, const PlotBox& map_box, const FigureMap& map, const ColourRange& range, bool missing) {
  const PlotBox box{map_box.right_px + 24.0, map_box.right_px + 24.0 + kBar_px, map_box.top_px, map_box.bottom_px};
  DrawnPixels bar;
  bar.columns = 1;
  bar.rows = 256;
  for (std::size_t i = 256; i-- > 0;) put(bar.rgb, viridis(static_cast<double>(i) / 255.0));
  bar.corner = {box.left_px, box.top_px};
  bar.width_px = kBar_px;
  bar.height_px = box.bottom_px - box.top_px;
  drawing.shapes.emplace_back(std::move(bar));
  const auto label = [&](double y_px, const std::string& text) {
    drawing.shapes.emplace_back(text_at(box.right_px + 6.0, y_px, text, TextAnchor::kStart));
  };
  label(box.top_px + 10.0, fmt::format("{}{:.4g}", range.cut ? "≥ " : "", range.high));
  label(0.5 * (box.top_px + box.bottom_px) + 4.5, fmt::format("{:.4g}", 0.5 * (range.low + range.high)));
  label(box.bottom_px, fmt::format("{}{:.4g}", range.cut ? "≤ " : "", range.low));
  drawing.shapes.emplace_back(text_at(box.left_px, box.bottom_px + 18.0, map.value_label, TextAnchor::kStart));
  if (missing)
    drawing.shapes.emplace_back(text_at(box.left_px, box.bottom_px + 36.0, "grey: missing", TextAnchor::kStart));
}

}  // namespace

double draw_map(Drawing& drawing, const FigureMap& map, double top_px) {
  if (map.columns == 0 || map.rows == 0 || map.value.size() != map.columns * map.rows)
    throw Error("plot: a map of " + std::to_string(map.columns) + " x " + std::to_string(map.rows) + " points has " +
                std::to_string(map.value.size()) + " values");
  const double width = map.x_spacing * static_cast<double>(map.columns);
  const double height = map.y_spacing * static_cast<double>(map.rows);
  const double widest_px = kPlotRight_px - kPlotLeft_px - kBarLabels_px;
  const double scale = std::min(widest_px / width, kTallestMap_px / height);
  // A map of one row is a strip that is still seen.
  const double width_px = std::max(20.0, scale * width), height_px = std::max(20.0, scale * height);
  const PlotBox box{kPlotLeft_px, kPlotLeft_px + width_px, top_px + kTitle_px, top_px + kTitle_px + height_px};
  const ColourRange range = range_of(map.value);
  DrawnPixels pixels = pixels_of(map, range);
  pixels.corner = {box.left_px, box.top_px};
  pixels.width_px = width_px;
  pixels.height_px = height_px;
  drawing.shapes.emplace_back(std::move(pixels));
  draw_frame(drawing, box, {0.0, width, box.left_px, box.right_px}, {0.0, height, box.bottom_px, box.top_px},
             map.x_label, map.y_label, map.title, false);
  const bool missing = std::any_of(map.value.begin(), map.value.end(), [](double v) { return !std::isfinite(v); });
  draw_bar(drawing, box, map, range, missing);
  return box.bottom_px + kAxis_px;
}

}  // namespace asperity
