#include "bent_path.h"

#include <algorithm>
#include <cmath>

#include "asperity/base/nan.h"
#include "asperity/signal/statistics.h"

namespace asperity {

namespace {

constexpr double kLeastBend = 0.02;       // of the length
constexpr double kSlowestCrossing = 0.3;  // of the mean: along its ribs a path sees nothing of a pattern
constexpr double kRateWindow_m = 2e-3;    // over which the rate is asked: noise of the path is no bend

}  // namespace

BentPath::BentPath(std::span<const Eigen::Vector2d> unrolled_m, double spacing_m) : spacing_m_(spacing_m) {
  if (unrolled_m.size() < 3) return;
  const Eigen::Vector2d chord_m = unrolled_m.back() - unrolled_m.front();
  const double length_m = spacing_m * static_cast<double>(unrolled_m.size() - 1);
  if (!(chord_m.norm() > 0.3 * length_m)) return;  // more a loop than a stroke
  const Eigen::Vector2d along = chord_m.normalized(), left(-along.y(), along.x());
  for (const Eigen::Vector2d& p_m : unrolled_m) {
    x_m_.push_back(along.dot(p_m - unrolled_m.front()));
    y_m_.push_back(left.dot(p_m - unrolled_m.front()));
  }
  const LinearFit line = linear_regression(x_m_, y_m_);
  double low = 0.0, high = 0.0, square = 0.0;
  for (std::size_t i = 0; i < x_m_.size(); ++i) {
    const double off = y_m_[i] - line.slope * x_m_[i] - line.intercept;
    low = std::min(low, off);
    high = std::max(high, off);
    square += off * off;
  }
  slope_ = line.slope;
  bend_m_ = high - low;
  bend_rms_m_ = std::sqrt(square / static_cast<double>(x_m_.size()));
  bends_ = bend_m_ > kLeastBend * length_m;
}

bool BentPath::crosses(double tangent) const {
  const auto window = std::min(x_m_.size() - 1, static_cast<std::size_t>(std::max(1.0, kRateWindow_m / spacing_m_)));
  const double mean =
      (coordinate(x_m_.size() - 1, tangent) - coordinate(0, tangent)) / static_cast<double>(x_m_.size() - 1);
  for (std::size_t i = 0; i + window < x_m_.size(); i += std::max<std::size_t>(1, window / 4)) {
    const double rate = (coordinate(i + window, tangent) - coordinate(i, tangent)) / static_cast<double>(window);
    if (!(rate > kSlowestCrossing * mean)) return false;
  }
  return true;
}

std::vector<double> BentPath::straightened(std::span<const double> height_m, double tangent) const {
  const std::size_t n = x_m_.size();
  const double first = coordinate(0, tangent), step = (coordinate(n - 1, tangent) - first) / static_cast<double>(n - 1);
  std::vector<double> out(n, kNan);
  std::size_t i = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const double at = first + step * static_cast<double>(k);
    // Noise of the path may step back by less than a window: the first point beyond counts.
    while (i + 2 < n && coordinate(i + 1, tangent) < at) ++i;
    const double from = coordinate(i, tangent), to = coordinate(i + 1, tangent);
    const double share = to > from ? std::clamp((at - from) / (to - from), 0.0, 1.0) : 0.0;
    if (share <= 0.0) {
      out[k] = height_m[i];
    } else if (share >= 1.0) {
      out[k] = height_m[i + 1];
    } else {
      out[k] = height_m[i] + share * (height_m[i + 1] - height_m[i]);
    }
  }
  return out;
}

double BentPath::spread_of_period(double tangent) const {
  const std::size_t n = x_m_.size();
  const auto window = std::min(n - 1, static_cast<std::size_t>(std::max(1.0, kRateWindow_m / spacing_m_)));
  const double mean_step = (coordinate(n - 1, tangent) - coordinate(0, tangent)) / static_cast<double>(n - 1);
  std::vector<double> periods;
  for (std::size_t i = 0; i + window < n; i += window) {
    const double rate = (coordinate(i + window, tangent) - coordinate(i, tangent)) / static_cast<double>(window);
    if (rate > 0.0) periods.push_back(mean_step / rate);
  }
  return periods.size() < 2 ? 0.0 : standard_deviation(periods) / mean(periods);
}

double BentPath::across_over_along(double tangent) const {
  const std::size_t n = x_m_.size();
  return (coordinate(n - 1, tangent) - coordinate(0, tangent)) /
         (spacing_m_ * static_cast<double>(n - 1) * std::hypot(1.0, tangent));
}

double BentPath::change_of_across(double tangent) const {
  // As many waves over x + t (slope x + bend): their length over x is kept, and across is (1 + t slope)/√(1 + t²) of
  // it.
  return slope_ / (1.0 + tangent * slope_) - tangent / (1.0 + tangent * tangent);
}

}  // namespace asperity
