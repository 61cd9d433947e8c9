#include "normal_leak.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "asperity/base/units.h"

namespace asperity {

namespace {

constexpr double kGrid_s = 0.01;
constexpr double kSlow_s = 0.2, kFast_s = 0.03;  // running means
constexpr double kEnds_s = 0.3;
constexpr double kLongestLag_s = 1.0;
constexpr double kShortest_s = 1.6;
constexpr double kSure = 4.0;  // of Student's t

std::vector<double> running_mean(const std::vector<double>& x, double seconds) {
  const auto half = static_cast<std::ptrdiff_t>(std::lround(0.5 * seconds / kGrid_s));
  const auto n = static_cast<std::ptrdiff_t>(x.size());
  std::vector<double> sums(x.size() + 1, 0.0), out(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) sums[i + 1] = sums[i] + x[i];
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    const auto reach = std::min({half, i, n - 1 - i});  // even at the ends
    out[static_cast<std::size_t>(i)] =
        (sums[static_cast<std::size_t>(i + reach + 1)] - sums[static_cast<std::size_t>(i - reach)]) /
        static_cast<double>(2 * reach + 1);
  }
  return out;
}

// Waves of 3 to 15 Hz. Three times, since strokes sway by millimetres; what the ends bend is cut off.
std::vector<double> tremor(const std::vector<double>& x) {
  std::vector<double> out = running_mean(running_mean(x, kFast_s), kFast_s);
  for (int k = 0; k < 3; ++k) {
    const std::vector<double> slow = running_mean(running_mean(out, kSlow_s), kSlow_s);
    for (std::size_t i = 0; i < out.size(); ++i) out[i] -= slow[i];
  }
  const auto cut = static_cast<std::ptrdiff_t>(std::lround(kEnds_s / kGrid_s));
  return {out.begin() + cut, out.end() - cut};
}

double product_at(const std::vector<double>& x, const std::vector<double>& y, std::size_t lag) {
  double sum = 0.0;
  for (std::size_t i = 0; i + lag < x.size(); ++i) sum += x[i] * y[i + lag];
  return sum;
}

// The longest run of moving samples, by their means over steps of the grid.
struct Gridded {
  std::vector<double> sway_m, rise_m;
};

Gridded on_grid(const TipMotion& motion, const OffBase& off, std::span<const char> moving) {
  std::size_t first = 0, last = 0;
  for (std::size_t i = 0; i < moving.size();) {
    if (moving[i] == 0) {
      ++i;
      continue;
    }
    std::size_t end = i;
    while (end < moving.size() && moving[end] != 0) ++end;
    if (end - i > last - first) first = i, last = end;
    i = end;
  }
  Gridded out;
  for (std::size_t i = first; i < last;) {
    const std::int64_t until_ns = motion.t_ns[i] + static_cast<std::int64_t>(kGrid_s * 1e9);
    double sway = 0.0, rise = 0.0, count = 0.0;
    for (; i < last && motion.t_ns[i] < until_ns; ++i) {
      sway += off.sway_m[i];
      rise += off.rise_m[i];
      count += 1.0;
    }
    out.sway_m.push_back(sway / count);
    out.rise_m.push_back(rise / count);
  }
  return out;
}

}  // namespace

OffBase off_base(const TipMotion& motion, const BasePath& base) {
  const std::size_t n = std::min(motion.size(), base.size());
  OffBase out{std::vector<double>(n), std::vector<double>(n)};
  // Base points lie under the tip, so the sway is the tip's own, along one direction: across travel and normal.
  Eigen::Vector3d across = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::Vector3d side = base.n_world[i].cross(motion.v_world_tip_mps[i]);
    across += across.dot(side) < 0.0 ? Eigen::Vector3d(-side) : side;  // forth and back are one line
  }
  if (across.norm() > 0.0) across.normalize();
  for (std::size_t i = 0; i < n; ++i) {
    out.sway_m[i] = across.dot(motion.p_world_tip_m[i] - motion.p_world_tip_m.front());
    out.rise_m[i] = base.n_world[i].dot(motion.p_world_tip_m[i] - base.p_world_m[i]);
  }
  return out;
}

double normal_leak(const TipMotion& motion, const OffBase& off, std::span<const char> moving) {
  const Gridded grid = on_grid(motion, off, moving);
  if (static_cast<double>(grid.sway_m.size()) * kGrid_s < kShortest_s) return 0.0;
  const std::vector<double> sway = tremor(grid.sway_m), rise = tremor(grid.rise_m);
  const double sway2 = product_at(sway, sway, 0), rise2 = product_at(rise, rise, 0);
  if (!(sway2 > 0.0 && rise2 > 0.0)) return 0.0;
  const double both = product_at(sway, rise, 0);
  double variance = 1.0;
  const auto lags = std::min(sway.size() - 1, static_cast<std::size_t>(kLongestLag_s / kGrid_s));
  for (std::size_t lag = 1; lag <= lags; ++lag)
    variance += 2.0 * product_at(sway, sway, lag) / sway2 * product_at(rise, rise, lag) / rise2;
  variance = std::max(variance, 1.0) / static_cast<double>(sway.size());
  const double square = both * both / (sway2 * rise2), freedom = 1.0 / variance - 2.0;
  return square * freedom > kSure * kSure * (1.0 - square) ? both / sway2 : 0.0;
}

}  // namespace asperity
