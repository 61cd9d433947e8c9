#include "plot_box.h"

#include <cmath>
#include <utility>
#include <vector>

#include "ticks.h"

namespace asperity {

namespace {

constexpr Colour kFrame{0x66, 0x66, 0x66}, kGrid{0xe6, 0xe6, 0xe6};
constexpr double kTick_px = 4.0;

void line(Drawing& drawing, DrawingPoint a, DrawingPoint b, const Colour& colour) {
  drawing.shapes.emplace_back(DrawnPath{{a, b}, colour, 1.0});
}

std::vector<Tick> ticks_of(const PlotScale& scale, double px_a_tick) {
  const int most = std::max(2, static_cast<int>(std::abs(scale.high_px - scale.low_px) / px_a_tick));
  return scale.logarithmic ? decade_ticks(scale.low, scale.high, most) : linear_ticks(scale.low, scale.high, most);
}

}  // namespace

double PlotScale::px(double value) const {
  const double share = logarithmic ? std::log(value / low) / std::log(high / low) : (value - low) / (high - low);
  return low_px + share * (high_px - low_px);
}

DrawnText text_at(double x_px, double y_px, std::string text, TextAnchor anchor) {
  DrawnText out;
  out.at = {x_px, y_px};
  out.text = std::move(text);
  out.anchor = anchor;
  return out;
}

void draw_frame(Drawing& drawing, const PlotBox& box, const PlotScale& x, const PlotScale& y,
                const std::string& x_label, const std::string& y_label, const std::string& title, bool grid) {
  for (const Tick& tick : ticks_of(x, 90.0)) {
    const double at_px = x.px(tick.value);
    if (grid) line(drawing, {at_px, box.top_px}, {at_px, box.bottom_px}, kGrid);
    line(drawing, {at_px, box.bottom_px}, {at_px, box.bottom_px + kTick_px}, kFrame);
    drawing.shapes.emplace_back(text_at(at_px, box.bottom_px + 18.0, tick.label, TextAnchor::kMiddle));
  }
  for (const Tick& tick : ticks_of(y, 36.0)) {
    const double at_px = y.px(tick.value);
    if (grid) line(drawing, {box.left_px, at_px}, {box.right_px, at_px}, kGrid);
    line(drawing, {box.left_px - kTick_px, at_px}, {box.left_px, at_px}, kFrame);
    drawing.shapes.emplace_back(text_at(box.left_px - 8.0, at_px + 4.5, tick.label, TextAnchor::kEnd));
  }
  drawing.shapes.emplace_back(DrawnPath{{{box.left_px, box.top_px},
                                         {box.right_px, box.top_px},
                                         {box.right_px, box.bottom_px},
                                         {box.left_px, box.bottom_px},
                                         {box.left_px, box.top_px}},
                                        kFrame,
                                        1.0});
  drawing.shapes.emplace_back(
      text_at(0.5 * (box.left_px + box.right_px), box.bottom_px + 38.0, x_label, TextAnchor::kMiddle));
  DrawnText upwards = text_at(22.0, 0.5 * (box.top_px + box.bottom_px), y_label, TextAnchor::kMiddle);
  upwards.upwards = true;
  drawing.shapes.emplace_back(std::move(upwards));
  DrawnText heading = text_at(box.left_px, box.top_px - 9.0, title, TextAnchor::kStart);
  heading.bold = true;
  drawing.shapes.emplace_back(std::move(heading));
}

}  // namespace asperity
