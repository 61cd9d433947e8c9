#include "noise_figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace asperity::app {

namespace {

constexpr double kTop_px = 46.0, kBottom_px = 270.0, kWidth_px = 250.0;
constexpr std::size_t kBins = 31;

double left_px(int axis) { return 40.0 + 290.0 * axis; }

std::string panel(const StaticInterval& rest, int axis) {
  const double sigma_m = rest.position_m[static_cast<std::size_t>(axis)].total;
  double farthest_m = 0.0;
  for (const Eigen::Vector3d& d : rest.deviation_m) farthest_m = std::max(farthest_m, std::abs(d[axis]));
  const double half_m = std::max(farthest_m, 3.0 * sigma_m);
  if (!(half_m > 0.0)) return "";
  std::vector<double> count(kBins, 0.0);
  for (const Eigen::Vector3d& d : rest.deviation_m) {
    const double place = 0.5 * (d[axis] / half_m + 1.0) * static_cast<double>(kBins);
    count[static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(kBins) - 1.0))] += 1.0;
  }
  const double bin_m = 2.0 * half_m / static_cast<double>(kBins);
  const auto gauss = [&](double x_m) {
    const double z = x_m / sigma_m;
    return static_cast<double>(rest.deviation_m.size()) * bin_m / (sigma_m * std::sqrt(2.0 * std::numbers::pi)) *
           std::exp(-0.5 * z * z);
  };
  const double highest = std::max(*std::max_element(count.begin(), count.end()), sigma_m > 0.0 ? gauss(0.0) : 0.0);
  const auto x_px = [&](double share) { return left_px(axis) + kWidth_px * share; };
  const auto y_px = [&](double value) { return kBottom_px - (kBottom_px - kTop_px) * value / (1.05 * highest); };
  std::string out;
  for (std::size_t i = 0; i < kBins; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(kBins);
    out += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"#9fb8d0\"/>\n",
                       x_px(share), y_px(count[i]), kWidth_px / static_cast<double>(kBins) - 1.0,
                       kBottom_px - y_px(count[i]));
  }
  if (sigma_m > 0.0) {
    std::string path;
    constexpr int kPoints = 120;
    for (int i = 0; i <= kPoints; ++i) {
      const double share = static_cast<double>(i) / kPoints;
      path +=
          fmt::format("{}{:.1f} {:.1f}", i == 0 ? "M" : "L", x_px(share), y_px(gauss((2.0 * share - 1.0) * half_m)));
    }
    out += fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"#b03020\" stroke-width=\"1.6\"/>\n", path);
  }
  out += fmt::format("<path d=\"M{0:.1f} {1:.1f}H{2:.1f}\" stroke=\"#444\"/>\n", x_px(0.0), kBottom_px, x_px(1.0));
  for (const double share : {0.0, 0.5, 1.0}) {
    out += fmt::format("<text x=\"{:.1f}\" y=\"288\" text-anchor=\"middle\">{:.2g}</text>\n", x_px(share),
                       (2.0 * share - 1.0) * half_m * 1e3);
  }
  return out + fmt::format("<text x=\"{:.1f}\" y=\"34\" text-anchor=\"middle\">{}: σ {:.3g} mm</text>\n", x_px(0.5),
                           "xyz"[axis], sigma_m * 1e3);
}

}  // namespace

std::string noise_svg(const StaticInterval& rest) {
  std::string out = fmt::format(
      "{} viewBox=\"0 0 900 320\" width=\"900\" height=\"320\" font-family=\"sans-serif\" "
      "font-size=\"13\">\n<rect width=\"900\" height=\"320\" fill=\"#fff\"/>\n",
      kNoiseSvgBegin);
  for (int axis = 0; axis < 3; ++axis) out += panel(rest, axis);
  out += fmt::format(
      "<text x=\"450\" y=\"311\" text-anchor=\"middle\">deviation from the mean, mm; {} poses of a static "
      "interval</text>\n</svg>\n",
      rest.deviation_m.size());
  return out;
}

}  // namespace asperity::app
