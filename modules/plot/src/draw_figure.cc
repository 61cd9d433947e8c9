#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "asperity/base/error.h"
#include "asperity/plot/figure.h"
#include "plot_box.h"
#include "thin_curve.h"

namespace asperity {

namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kPanelHeight_px = 230.0, kTallest_px = 620.0;

struct Range {
  double low = kInf, high = -kInf;

  void add(double value, bool logarithmic) {
    if (!std::isfinite(value) || (logarithmic && !(value > 0.0))) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  bool empty() const { return !(high >= low); }
  // Never of no width, and with `share` of it on either side.
  void widen(double share, bool logarithmic) {
    if (logarithmic) {
      const double factor = std::max(1.05, std::pow(high / low, share));
      low /= factor;
      high *= factor;
      return;
    }
    const double more = high > low ? share * (high - low) : std::max(1e-300, 0.5 * std::abs(high));
    if (more == 0.0 && high > low) return;
    low -= more;
    high += more;
    if (!(high > low)) low -= 0.5, high += 0.5;
  }
};

void check_sizes(const FigurePanel& panel) {
  for (const FigureCurve& curve : panel.curves)
    if (curve.x.size() != curve.y.size()) throw Error("plot: the curve '" + curve.name + "' has unequal columns");
  for (const FigureBand& band : panel.bands)
    if (band.x.size() != band.low.size() || band.x.size() != band.high.size())
      throw Error("plot: the band '" + band.name + "' has unequal columns");
}

std::pair<Range, Range> ranges_of(const FigurePanel& panel) {
  Range x, y;
  const auto add = [&](double at, double value) {
    if (!std::isfinite(at) || !std::isfinite(value)) return;
    if ((panel.x.logarithmic && !(at > 0.0)) || (panel.y.logarithmic && !(value > 0.0))) return;
    x.add(at, false);
    y.add(value, false);
  };
  for (const FigureCurve& curve : panel.curves)
    for (std::size_t i = 0; i < curve.x.size(); ++i) add(curve.x[i], curve.y[i]);
  for (const FigureBand& band : panel.bands) {
    for (std::size_t i = 0; i < band.x.size(); ++i) {
      add(band.x[i], band.low[i]);
      add(band.x[i], band.high[i]);
    }
  }
  return {x, y};
}

// The stretches without a gap, in px. A value that a logarithmic axis cannot show is a gap.
template <class Use>
void for_each_run(const std::vector<double>& x, const std::vector<double>& y, const PlotScale& x_scale,
                  const PlotScale& y_scale, const Use& use) {
  std::vector<DrawingPoint> run;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const DrawingPoint p{x_scale.px(x[i]), y_scale.px(y[i])};
    if (std::isfinite(p.x_px) && std::isfinite(p.y_px)) {
      run.push_back(p);
      continue;
    }
    if (!run.empty()) use(run);
    run.clear();
  }
  if (!run.empty()) use(run);
}

void draw_band(Drawing& drawing, const FigureBand& band, const PlotScale& x, const PlotScale& y) {
  // A column of half a pixel is as high as the band's highest and as low as its lowest there. Below a logarithmic
  // axis the band ends at the axis.
  std::vector<DrawingPoint> top, bottom;
  const auto flush = [&] {
    if (!top.empty()) {
      std::vector<DrawingPoint> outline = top;
      outline.insert(outline.end(), bottom.rbegin(), bottom.rend());
      drawing.shapes.emplace_back(DrawnPath{std::move(outline), band.colour, 0.0, true});
    }
    top.clear();
    bottom.clear();
  };
  for (std::size_t i = 0; i < band.x.size(); ++i) {
    const double x_px = x.px(band.x[i]), high_px = y.px(band.high[i]);
    const double low_px = y.logarithmic && band.low[i] <= 0.0 ? y.low_px : y.px(band.low[i]);
    if (!std::isfinite(x_px) || !std::isfinite(high_px) || !std::isfinite(low_px)) {
      flush();
      continue;
    }
    if (!top.empty() && std::floor(2.0 * top.back().x_px) == std::floor(2.0 * x_px)) {
      top.back().y_px = std::min(top.back().y_px, high_px);
      bottom.back().y_px = std::max(bottom.back().y_px, low_px);
      continue;
    }
    top.push_back({x_px, high_px});
    bottom.push_back({x_px, low_px});
  }
  flush();
}

void draw_curve(Drawing& drawing, const FigureCurve& curve, const PlotScale& x, const PlotScale& y) {
  for_each_run(curve.x, curve.y, x, y, [&](const std::vector<DrawingPoint>& run) {
    if (curve.points || run.size() == 1) {
      for (const DrawingPoint& p : run)
        drawing.shapes.emplace_back(DrawnDisc{p, curve.points ? 2.2 : 0.8, curve.colour});
      return;
    }
    drawing.shapes.emplace_back(DrawnPath{thin_curve(run), curve.colour, 1.3, false, curve.dashed});
  });
}

std::size_t letters(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

// Names with their colours, from the right end of the title's line to the left.
void draw_legend(Drawing& drawing, const FigurePanel& panel, const PlotBox& box) {
  double right_px = box.right_px;
  const double y_px = box.top_px - 9.0;
  const auto entry = [&](const std::string& name, const Colour& colour, double thick_px, bool dashed) {
    if (name.empty()) return;
    drawing.shapes.emplace_back(text_at(right_px, y_px, name, TextAnchor::kEnd));
    right_px -= 7.4 * static_cast<double>(letters(name)) + 6.0;
    drawing.shapes.emplace_back(
        DrawnPath{{{right_px - 20.0, y_px - 4.0}, {right_px, y_px - 4.0}}, colour, thick_px, false, dashed});
    right_px -= 34.0;
  };
  for (auto it = panel.bands.rbegin(); it != panel.bands.rend(); ++it) entry(it->name, it->colour, 9.0, false);
  for (auto it = panel.curves.rbegin(); it != panel.curves.rend(); ++it)
    entry(it->name, it->colour, it->points ? 5.0 : 2.0, it->dashed);
}

double draw_panel(Drawing& drawing, const FigurePanel& panel, double top_px) {
  check_sizes(panel);
  auto [x_range, y_range] = ranges_of(panel);
  const bool empty = x_range.empty() || y_range.empty();
  if (empty) x_range = y_range = {0.1, 1.0};
  x_range.widen(panel.equal_scales ? 0.02 : 0.0, panel.x.logarithmic);
  y_range.widen(0.04, panel.y.logarithmic);
  PlotBox box{kPlotLeft_px, kPlotRight_px, top_px + kTitle_px, top_px + kTitle_px + kPanelHeight_px};
  if (panel.equal_scales && !empty) {
    const double scale = std::min((box.right_px - box.left_px) / (x_range.high - x_range.low),
                                  kTallest_px / (y_range.high - y_range.low));
    const double height_px = std::max(60.0, scale * (y_range.high - y_range.low));
    box.bottom_px = box.top_px + height_px;
    // What is left of the box in either direction is shown as well.
    const auto centre = [](Range& range, double length) {
      const double middle = 0.5 * (range.low + range.high);
      range = {middle - 0.5 * length, middle + 0.5 * length};
    };
    centre(x_range, (box.right_px - box.left_px) / scale);
    centre(y_range, height_px / scale);
  }
  const PlotScale x{x_range.low, x_range.high, box.left_px, box.right_px, panel.x.logarithmic};
  const PlotScale y{y_range.low, y_range.high, box.bottom_px, box.top_px, panel.y.logarithmic};
  draw_frame(drawing, box, x, y, panel.x.label, panel.y.label, panel.title, true);
  for (const FigureBand& band : panel.bands) draw_band(drawing, band, x, y);
  for (const FigureCurve& curve : panel.curves) draw_curve(drawing, curve, x, y);
  draw_legend(drawing, panel, box);
  if (empty) {
    drawing.shapes.emplace_back(text_at(0.5 * (box.left_px + box.right_px), 0.5 * (box.top_px + box.bottom_px),
                                        "no values", TextAnchor::kMiddle));
  }
  return box.bottom_px + kAxis_px;
}

}  // namespace

Drawing draw_figure(const Figure& figure) {
  Drawing out;
  out.width_px = kFigureWidth_px;
  double y_px = 10.0;
  const auto heading = [&](const std::string& text, const Colour& colour) {
    if (text.empty()) return;
    DrawnText line = text_at(kPlotLeft_px, y_px + 16.0, text, TextAnchor::kStart);
    line.bold = true;
    line.size_px = 15.0;
    line.colour = colour;
    out.shapes.emplace_back(std::move(line));
    y_px += 26.0;
  };
  heading(figure.title, {0x11, 0x11, 0x11});
  heading(figure.note, {0xb0, 0x20, 0x10});
  for (const auto& panel : figure.panels) {
    y_px = std::holds_alternative<FigureMap>(panel) ? draw_map(out, std::get<FigureMap>(panel), y_px)
                                                    : draw_panel(out, std::get<FigurePanel>(panel), y_px);
    y_px += 6.0;
  }
  out.height_px = std::ceil(y_px + 4.0);
  return out;
}

}  // namespace asperity
