#include "asperity/profile/compare_profiles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/profile/resample_over_path.h"
#include "asperity/signal/zero_phase.h"
#include "gap_runs.h"

namespace asperity {

namespace {

struct BandPassed {
  std::ptrdiff_t first = 0;
  std::vector<double> height_m;  // nan in gaps and margins
};

PathKnots knots_of(std::span<const double> s_m, std::span<const double> height_m, const ComparisonConfig& config,
                   const char* side) {
  if (s_m.size() != height_m.size()) {
    throw Error(std::string("comparison: the ") + side + " profile has " + std::to_string(s_m.size()) +
                " positions and " + std::to_string(height_m.size()) + " heights");
  }
  const std::array<std::span<const double>, 1> channels{height_m};
  PathKnots knots = gather_knots(s_m, channels, {}, 0.25 * config.spacing_m);
  if (knots.s_m.size() < 8) throw Error(std::string("comparison: the ") + side + " profile has fewer than 8 heights");
  return knots;
}

// The knots moved by shift_m, without those strictly inside `gaps` (pairs of s, rising).
BandPassed band_pass(PathKnots knots, double shift_m, const std::vector<std::pair<double, double>>& gaps,
                     const ComparisonConfig& config) {
  std::vector<double> s_m, height_m_in;
  std::size_t g = 0;
  for (std::size_t i = 0; i < knots.s_m.size(); ++i) {
    while (g < gaps.size() && gaps[g].second <= knots.s_m[i]) ++g;
    if (g < gaps.size() && knots.s_m[i] > gaps[g].first) continue;
    s_m.push_back(knots.s_m[i]);
    height_m_in.push_back(knots.channels[0][i]);
  }
  knots.s_m = std::move(s_m);
  knots.channels[0] = std::move(height_m_in);
  if (knots.s_m.empty()) return {};
  for (double& s : knots.s_m) s += shift_m;
  BandPassed out;
  count_points(knots.s_m.back() - knots.s_m.front(), config.spacing_m);
  out.first = static_cast<std::ptrdiff_t>(std::ceil(knots.s_m.front() / config.spacing_m));
  const auto last = static_cast<std::ptrdiff_t>(std::floor(knots.s_m.back() / config.spacing_m));
  const auto count = static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, last - out.first + 1));
  const std::vector<double> height_m = resample_smooth(knots, out.first, count, config.spacing_m, config.max_hole_m);
  const double rate_per_mm = 1e-3 / config.spacing_m;
  const double high = std::min(config.high_cycles_per_mm, 0.38 * rate_per_mm);
  out.height_m = filter_runs(height_m, static_cast<std::size_t>(config.bridge_m / config.spacing_m), {}, 8,
                             [&](std::span<const double> run) {
                               const auto above = zero_phase_highpass(run, config.low_cycles_per_mm, rate_per_mm);
                               return zero_phase_lowpass(above, high, rate_per_mm);
                             });
  // How far the filter's answer to an end or a bridge reaches. Ends of the profile count as gaps.
  const auto total = static_cast<std::ptrdiff_t>(count);
  const auto bridge = static_cast<std::ptrdiff_t>(config.bridge_m / config.spacing_m);
  std::vector<char> keep(count, 1);
  for (std::ptrdiff_t k = -1; k <= total;) {
    const auto gap = [&](std::ptrdiff_t i) {
      return i < 0 || i >= total || !std::isfinite(out.height_m[static_cast<std::size_t>(i)]);
    };
    if (!gap(k)) {
      ++k;
      continue;
    }
    std::ptrdiff_t end = k + 1;
    while (end < total && gap(end)) ++end;
    const bool bridged = k >= 0 && end < total && end - k <= bridge;
    const auto margin =
        static_cast<std::ptrdiff_t>((bridged ? config.bridge_margin_m : config.margin_m) / config.spacing_m);
    for (auto i = std::max<std::ptrdiff_t>(0, k - margin); i < std::min(end + margin, total); ++i)
      keep[static_cast<std::size_t>(i)] = 0;
    k = end;
  }
  for (std::size_t k = 0; k < count; ++k) {
    if (keep[k] == 0) out.height_m[k] = std::numeric_limits<double>::quiet_NaN();
  }
  return out;
}

// Where the measured side has no heights, the true one must have none either: a lift of some millimetres there
// would ring through the band-pass far beyond the gap.
std::vector<std::pair<double, double>> gaps_of(const PathKnots& knots, double shift_m, const ComparisonConfig& config) {
  std::vector<std::pair<double, double>> gaps;
  for (std::size_t i = 1; i < knots.s_m.size(); ++i) {
    if (knots.s_m[i] - knots.s_m[i - 1] > config.max_hole_m)
      gaps.emplace_back(knots.s_m[i - 1] + shift_m, knots.s_m[i] + shift_m);
  }
  return gaps;
}

struct Moments {
  double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, yy = 0.0, xy = 0.0, dd = 0.0;

  double covariance() const { return xy / n - x / n * (y / n); }
  double correlation() const {
    const double square = (xx / n - x / n * (x / n)) * (yy / n - y / n * (y / n));
    return square > 0.0 ? covariance() / std::sqrt(square) : 0.0;
  }
};

// x true, y measured.
Moments overlap(const BandPassed& truth, const BandPassed& measured) {
  Moments m;
  const auto begin = std::max(truth.first, measured.first);
  const auto end = std::min(truth.first + static_cast<std::ptrdiff_t>(truth.height_m.size()),
                            measured.first + static_cast<std::ptrdiff_t>(measured.height_m.size()));
  for (auto k = begin; k < end; ++k) {
    const double x = truth.height_m[static_cast<std::size_t>(k - truth.first)];
    const double y = measured.height_m[static_cast<std::size_t>(k - measured.first)];
    if (!std::isfinite(x) || !std::isfinite(y)) continue;
    m.n += 1.0;
    m.x += x;
    m.y += y;
    m.xx += x * x;
    m.yy += y * y;
    m.xy += x * y;
    m.dd += (y - x) * (y - x);
  }
  return m;
}

// One side of a comparison at many lags: its heights, 0 where there is none, their sums up to each point, and the runs
// of points that have one.
class LaggedSide {
 public:
  struct Run {
    std::ptrdiff_t begin = 0, end = 0;
  };

  explicit LaggedSide(const BandPassed& side) : height_m_(side.height_m), first_(side.first) {
    const auto n = static_cast<std::ptrdiff_t>(height_m_.size());
    sum_.reserve(height_m_.size() + 1);
    square_.reserve(height_m_.size() + 1);
    sum_.push_back(0.0);
    square_.push_back(0.0);
    for (std::ptrdiff_t k = 0; k < n; ++k) {
      double& height_m = height_m_[static_cast<std::size_t>(k)];
      if (!std::isfinite(height_m)) {
        height_m = 0.0;
      } else if (!runs_.empty() && runs_.back().end == first_ + k) {
        ++runs_.back().end;
      } else {
        runs_.push_back({first_ + k, first_ + k + 1});
      }
      sum_.push_back(sum_.back() + height_m);
      square_.push_back(square_.back() + height_m * height_m);
    }
  }

  const std::vector<Run>& runs() const { return runs_; }
  const double* at(std::ptrdiff_t k) const { return height_m_.data() + (k - first_); }
  double sum(const Run& run) const { return difference(sum_, run); }
  double square(const Run& run) const { return difference(square_, run); }

 private:
  double difference(const std::vector<double>& total, const Run& run) const {
    return total[static_cast<std::size_t>(run.end - first_)] - total[static_cast<std::size_t>(run.begin - first_)];
  }

  std::vector<double> height_m_;
  std::ptrdiff_t first_;
  std::vector<double> sum_, square_;
  std::vector<Run> runs_;
};

double dot(const double* a, const double* b, std::ptrdiff_t n) {
  double s0 = 0.0, s1 = 0.0, s2 = 0.0, s3 = 0.0;
  std::ptrdiff_t k = 0;
  for (; k + 4 <= n; k += 4) {
    s0 += a[k] * b[k];
    s1 += a[k + 1] * b[k + 1];
    s2 += a[k + 2] * b[k + 2];
    s3 += a[k + 3] * b[k + 3];
  }
  for (; k < n; ++k) s0 += a[k] * b[k];
  return (s0 + s1) + (s2 + s3);
}

// x true, y measured, the measured side moved by `lag` points; without `dd`.
Moments overlap_at(const LaggedSide& truth, const LaggedSide& measured, std::ptrdiff_t lag) {
  Moments m;
  auto one = truth.runs().begin();
  auto other = measured.runs().begin();
  while (one != truth.runs().end() && other != measured.runs().end()) {
    const LaggedSide::Run both{std::max(one->begin, other->begin + lag), std::min(one->end, other->end + lag)};
    if (both.begin < both.end) {
      const LaggedSide::Run back{both.begin - lag, both.end - lag};
      m.n += static_cast<double>(both.end - both.begin);
      m.x += truth.sum(both);
      m.xx += truth.square(both);
      m.y += measured.sum(back);
      m.yy += measured.square(back);
      m.xy += dot(truth.at(both.begin), measured.at(back.begin), both.end - both.begin);
    }
    if (one->end < other->end + lag) {
      ++one;
    } else {
      ++other;
    }
  }
  return m;
}

// Both sides on the points of their common span.
ComparedHeights common_heights(const BandPassed& truth, const BandPassed& measured, double spacing_m) {
  ComparedHeights out;
  const auto end = [](const BandPassed& one) { return one.first + static_cast<std::ptrdiff_t>(one.height_m.size()); };
  for (auto k = std::max(truth.first, measured.first); k < std::min(end(truth), end(measured)); ++k) {
    out.s_m.push_back(static_cast<double>(k) * spacing_m);
    out.true_m.push_back(truth.height_m[static_cast<std::size_t>(k - truth.first)]);
    out.measured_m.push_back(measured.height_m[static_cast<std::size_t>(k - measured.first)]);
  }
  return out;
}

double span_m(const PathKnots& knots) { return knots.s_m.back() - knots.s_m.front(); }

}  // namespace

double comparison_limit_cycles_per_mm(double rate_hz, double speed_mps) {
  if (!(rate_hz > 0.0) || !(speed_mps > 0.0)) {
    throw Error("comparison: rate " + number_text(rate_hz) + " Hz, speed " + number_text(speed_mps) +
                " m/s; both must be positive");
  }
  return std::min(4.0, 0.4 * rate_hz / (1e3 * speed_mps));
}

AlignedProfiles align_profiles(std::span<const double> measured_s_m, std::span<const double> measured_height_m,
                               std::span<const double> true_s_m, std::span<const double> true_height_m,
                               const ComparisonConfig& config) {
  if (!(config.low_cycles_per_mm > 0.0) || !(config.high_cycles_per_mm > config.low_cycles_per_mm) ||
      !(config.max_shift_m >= 0.0)) {
    throw Error("comparison: band " + number_text(config.low_cycles_per_mm) + " to " +
                number_text(config.high_cycles_per_mm) + " cycles/mm, shift " + number_text(config.max_shift_m) + " m");
  }
  const PathKnots measured_knots = knots_of(measured_s_m, measured_height_m, config, "measured");
  const PathKnots true_knots = knots_of(true_s_m, true_height_m, config, "true");
  const BandPassed truth = band_pass(true_knots, 0.0, gaps_of(measured_knots, 0.0, config), config);
  const BandPassed measured = band_pass(measured_knots, 0.0, {}, config);

  AlignedProfiles aligned;
  ProfileComparison& out = aligned.comparison;
  out.length_error_percent = 100.0 * (span_m(measured_knots) / span_m(true_knots) - 1.0);
  const auto reach = static_cast<std::ptrdiff_t>(config.max_shift_m / config.spacing_m);
  // An overlap much shorter than the whole could fit by chance.
  const LaggedSide true_side(truth), measured_side(measured);
  const double enough = std::max(10.0, 0.5 * overlap_at(true_side, measured_side, 0).n);
  std::ptrdiff_t best = 0;
  double highest = -2.0;
  for (std::ptrdiff_t lag = -reach; lag <= reach; ++lag) {
    const Moments m = overlap_at(true_side, measured_side, lag);
    if (m.n >= enough && m.correlation() > highest) {
      highest = m.correlation();
      best = lag;
    }
  }
  if (highest < -1.5) return aligned;
  const double before = overlap_at(true_side, measured_side, best - 1).correlation(),
               after = overlap_at(true_side, measured_side, best + 1).correlation();
  const double bend = before - 2.0 * highest + after;
  const double fraction = bend < 0.0 ? std::clamp(0.5 * (before - after) / bend, -0.5, 0.5) : 0.0;
  out.shift_m =
      std::clamp((static_cast<double>(best) + fraction) * config.spacing_m, -config.max_shift_m, config.max_shift_m);

  const BandPassed moved = band_pass(measured_knots, out.shift_m, {}, config);
  const BandPassed beside = band_pass(true_knots, 0.0, gaps_of(measured_knots, out.shift_m, config), config);
  const Moments m = overlap(beside, moved);
  if (m.n < 10.0) return aligned;
  out.correlation = m.correlation();
  const double true_variance = m.xx / m.n - m.x / m.n * (m.x / m.n);
  if (true_variance > 0.0) out.gain = m.covariance() / true_variance;
  out.rms_um = 1e6 * std::sqrt(m.dd / m.n);
  out.true_rms_um = 1e6 * std::sqrt(m.xx / m.n);
  out.compared_m = m.n * config.spacing_m;
  aligned.heights = common_heights(beside, moved, config.spacing_m);
  return aligned;
}

ProfileComparison compare_profiles(std::span<const double> measured_s_m, std::span<const double> measured_height_m,
                                   std::span<const double> true_s_m, std::span<const double> true_height_m,
                                   const ComparisonConfig& config) {
  return align_profiles(measured_s_m, measured_height_m, true_s_m, true_height_m, config).comparison;
}

}  // namespace asperity
