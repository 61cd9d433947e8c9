#include "feel_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace asperity::app {

namespace {

constexpr double kLeft_px = 72.0, kRight_px = 884.0;

// A strip of the drawing, with its range of values.
struct Strip {
  double top_px, bottom_px;
  double low, high;

  double y_px(double y) const { return bottom_px - (bottom_px - top_px) * (y - low) / (high - low); }
};

Strip strip_of(const std::vector<double>& y, double top_px, double bottom_px) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const double value : y) {
    if (!std::isfinite(value)) continue;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  if (!(high > low)) return {top_px, bottom_px, 0.0, 1.0};
  return {top_px, bottom_px, low, high};
}

double x_px(double share) { return kLeft_px + share * (kRight_px - kLeft_px); }

std::string line_svg(const std::vector<double>& y, const Strip& strip, const char* colour) {
  std::string path;
  bool pen = false;
  for (std::size_t i = 0; i < y.size(); ++i) {
    const bool there = std::isfinite(y[i]);
    if (there) {
      const double share = static_cast<double>(i) / static_cast<double>(std::max<std::size_t>(1, y.size() - 1));
      path += fmt::format("{}{:.1f} {:.1f}", pen ? "L" : "M", x_px(share), strip.y_px(y[i]));
    }
    pen = there;
  }
  return fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.6\"/>\n", path, colour);
}

std::string range_svg(const Strip& strip, double scale, const char* unit) {
  std::string out;
  for (const double value : {strip.low, strip.high}) {
    out += fmt::format("<text x=\"{}\" y=\"{:.1f}\" text-anchor=\"end\">{:.2f}</text>\n", kLeft_px - 8.0,
                       strip.y_px(value) + 4.5, value * scale);
  }
  return out + fmt::format("<text transform=\"translate(14 {:.1f}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n",
                           0.5 * (strip.top_px + strip.bottom_px), unit);
}

std::string ways_svg(const ForcePlot& plot) {
  const double length_mm = 1e3 * plot.spacing_m * static_cast<double>(plot.force_N.size() - 1);
  const double step_mm = length_mm > 50.0 ? 10.0 : length_mm > 15.0 ? 2.5 : 1.0;
  std::string out;
  for (double mm = 0.0; mm <= length_mm * (1.0 + 1e-9); mm += step_mm) {
    const double at_px = x_px(mm / length_mm);
    out += fmt::format(
        "<path d=\"M{0:.1f} 44V248\" stroke=\"#e4e4e4\"/><text x=\"{0:.1f}\" y=\"266\" "
        "text-anchor=\"middle\">{1:g}</text>\n",
        at_px, mm + 1e3 * plot.from_m);
  }
  return out;
}

}  // namespace

std::string force_svg(const ForcePlot& plot) {
  const Strip force = strip_of(plot.force_N, 48.0, 168.0), height = strip_of(plot.height_m, 188.0, 244.0);
  return fmt::format(
             "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 900 300\" width=\"900\" height=\"300\" "
             "font-family=\"sans-serif\" font-size=\"14\">\n<rect width=\"900\" height=\"300\" fill=\"#fff\"/>\n"
             "<text x=\"{}\" y=\"28\" font-weight=\"bold\" fill=\"#111\">{}</text>\n<g fill=\"#333\">\n",
             kLeft_px, plot.title) +
         ways_svg(plot) + range_svg(force, 1.0, "force, N") + range_svg(height, 1e3, "H, mm") +
         fmt::format("<text x=\"{}\" y=\"288\" text-anchor=\"middle\">path length of the stroke, mm</text>\n</g>\n",
                     0.5 * (kLeft_px + kRight_px)) +
         line_svg(plot.force_N, force, "#1558a0") + line_svg(plot.height_m, height, "#888") + "</svg>\n";
}

}  // namespace asperity::app
