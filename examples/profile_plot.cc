#include "profile_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "asperity/base/error.h"

namespace asperity::examples {
namespace {

constexpr double kWidth_px = 900.0, kHeight_px = 300.0;
constexpr double kLeft_px = 72.0, kRight_px = 884.0, kTop_px = 44.0, kBottom_px = 248.0;

struct Point {
  double x_mm, y_um, sigma_um;
};

std::vector<Point> points_in(const Profile& profile, double shift_m, const ProfilePlot& plot) {
  std::vector<Point> out;
  double sum_um = 0.0;
  for (std::size_t i = 0; i < profile.size(); ++i) {
    const double s_m = profile.s_m[i] + shift_m;
    if (s_m < plot.from_m || s_m > plot.to_m || !std::isfinite(profile.height_m[i])) continue;
    const double sigma_um = profile.sigma_m.empty() ? 0.0 : 1e6 * profile.sigma_m[i];
    out.push_back({1e3 * s_m, 1e6 * profile.height_m[i], std::isfinite(sigma_um) ? sigma_um : 0.0});
    sum_um += out.back().y_um;
  }
  if (out.size() < 2) throw Error("profile_svg: the part to be drawn holds no heights");
  for (Point& point : out) point.y_um -= sum_um / static_cast<double>(out.size());
  return out;
}

// The first of 1, 2, 5, 10, … that divides `range` into at most `most` parts.
double tick_step(double range, int most) {
  double step = std::pow(10.0, std::floor(std::log10(range)) - 1.0);
  for (int i = 0; range / step > most; ++i) step *= i % 3 == 1 ? 2.5 : 2.0;
  return step;
}

struct Axes {
  double x0_mm, x1_mm, y0_um, y1_um;

  double x_px(double x_mm) const { return kLeft_px + (kRight_px - kLeft_px) * (x_mm - x0_mm) / (x1_mm - x0_mm); }
  double y_px(double y_um) const { return kBottom_px - (kBottom_px - kTop_px) * (y_um - y0_um) / (y1_um - y0_um); }
};

std::string path(const std::vector<Point>& points, const Axes& axes) {
  std::string out;
  for (const Point& point : points) {
    out += fmt::format("{}{:.1f} {:.1f}", out.empty() ? "M" : "L", axes.x_px(point.x_mm), axes.y_px(point.y_um));
  }
  return out;
}

// Every fourth point: the standard deviation changes slowly.
std::string band(const std::vector<Point>& points, const Axes& axes) {
  std::vector<Point> outline;
  for (std::size_t i = 0; i < points.size(); i += 4)
    outline.push_back({points[i].x_mm, points[i].y_um + 2.0 * points[i].sigma_um, 0.0});
  const std::size_t half = outline.size();
  for (std::size_t i = half; i-- > 0;)
    outline.push_back({outline[i].x_mm, outline[i].y_um - 4.0 * points[4 * i].sigma_um, 0.0});
  return path(outline, axes) + "Z";
}

// The multiples of `step` from `low` to `high`.
std::vector<double> ticks(double low, double high, double step) {
  std::vector<double> out;
  for (auto i = std::llround(std::ceil(low / step - 1e-9)); static_cast<double>(i) <= high / step + 1e-9; ++i) {
    out.push_back(static_cast<double>(i) * step);
  }
  return out;
}

// With a minus sign, not a hyphen.
std::string label(double value) { return fmt::format("{}{:g}", value < 0.0 ? "−" : "", std::abs(value)); }

std::string axes_svg(const Axes& axes) {
  std::string out = "<g stroke=\"#e4e4e4\">";
  std::string labels = "<g fill=\"#333\">";
  for (const double y_um : ticks(axes.y0_um, axes.y1_um, tick_step(axes.y1_um - axes.y0_um, 6))) {
    const double y_px = axes.y_px(y_um);
    out += fmt::format("<path d=\"M{} {:.1f}H{}\"/>", kLeft_px, y_px, kRight_px);
    labels += fmt::format("<text x=\"{}\" y=\"{:.1f}\" text-anchor=\"end\">{}</text>", kLeft_px - 8.0, y_px + 4.5,
                          label(y_um));
  }
  for (const double x_mm : ticks(axes.x0_mm, axes.x1_mm, tick_step(axes.x1_mm - axes.x0_mm, 10))) {
    const double x_px = axes.x_px(x_mm);
    out += fmt::format("<path d=\"M{:.1f} {}V{}\"/>", x_px, kTop_px, kBottom_px);
    labels += fmt::format("<text x=\"{:.1f}\" y=\"{}\" text-anchor=\"middle\">{}</text>", x_px, kBottom_px + 18.0,
                          label(x_mm));
  }
  labels += fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">arc length, mm</text>",
                        0.5 * (kLeft_px + kRight_px), kHeight_px - 12.0);
  labels += fmt::format("<text transform=\"translate(18 {}) rotate(-90)\" text-anchor=\"middle\">height, µm</text>",
                        0.5 * (kTop_px + kBottom_px));
  return out + "</g>\n" + labels + "</g>\n";
}

std::string legend_svg(const std::string& title) {
  return fmt::format(
      "<text x=\"{0}\" y=\"28\" font-weight=\"bold\" fill=\"#111\">{1}</text>\n"
      "<g fill=\"#333\"><path d=\"M560 23H590\" stroke=\"#b6b6b6\" stroke-width=\"5\"/><text x=\"598\" y=\"28\">true"
      "</text>\n<path d=\"M660 23H690\" stroke=\"#1558a0\" stroke-width=\"1.8\"/><text x=\"698\" "
      "y=\"28\">measured</text>"
      "\n<rect x=\"790\" y=\"15\" width=\"30\" height=\"16\" fill=\"#cfe2f5\"/><text x=\"828\" y=\"28\">± 2 σ</text>"
      "</g>\n",
      kLeft_px, title);
}

}  // namespace

std::string profile_svg(const Profile& measured, const Profile& truth, const ProfilePlot& plot) {
  const std::vector<Point> ours = points_in(measured, plot.shift_m, plot);
  const std::vector<Point> real = points_in(truth, 0.0, plot);
  Axes axes{1e3 * plot.from_m, 1e3 * plot.to_m, 0.0, 0.0};
  for (const std::vector<Point>* points : {&ours, &real}) {
    for (const Point& point : *points) {
      axes.y0_um = std::min(axes.y0_um, point.y_um - 2.2 * point.sigma_um);
      axes.y1_um = std::max(axes.y1_um, point.y_um + 2.2 * point.sigma_um);
    }
  }
  return fmt::format(
             "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" "
             "font-family=\"sans-serif\" font-size=\"14\">\n<rect width=\"{0}\" height=\"{1}\" fill=\"#fff\"/>\n",
             kWidth_px, kHeight_px) +
         fmt::format("<path d=\"{}\" fill=\"#cfe2f5\"/>\n", band(ours, axes)) + axes_svg(axes) +
         fmt::format(
             "<g fill=\"none\" stroke-linejoin=\"round\"><path d=\"{}\" stroke=\"#b6b6b6\" "
             "stroke-width=\"5\"/>\n<path d=\"{}\" stroke=\"#1558a0\" stroke-width=\"1.8\"/></g>\n",
             path(real, axes), path(ours, axes)) +
         legend_svg(plot.title) + "</svg>\n";
}

}  // namespace asperity::examples
