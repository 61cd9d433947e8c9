#include "asperity/profile/noise_at_rest.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/profile/height_error_density.h"
#include "asperity/signal/spectrum.h"

namespace asperity {

namespace {

constexpr double kShortest_s = 1.0;
constexpr double kEnds_s = 0.15;
constexpr double kRate_Hz = 50.0;                      // of the means that are transformed
constexpr std::size_t kFirstBin = 2;                   // the taper spreads the mean over the bins below
constexpr double kLowest_Hz = 1.0, kHighest_Hz = 6.0;  // a hand's tremor begins at 7 Hz
constexpr double kLeastInertial = 3.0;                 // times as much noise has the tracker there
constexpr double kTaperVariance = 1.0 + 2.0 * 4.0 / 9.0 + 2.0 / 36.0;
constexpr double kMiddle_Hz = 0.5, kSpread = 1.1748;  // of ln f₁: ln(10)/1.96
constexpr double kWhiteSpread = 0.3;
constexpr double kMotion_Hz = 3.0;
constexpr double kMotionDecades = 3.0;                    // to either side of the white noise
constexpr int kCorners = 25, kWhites = 7, kMotions = 13;  // of the grid

constexpr double kLongestStep_s = 1.5 / kRate_Hz;

struct RestingRun {
  std::size_t first = 0, last = 0;
};

// The rests, without their ends.
std::vector<RestingRun> find_rests(std::span<const double> t_s, std::span<const char> resting) {
  std::vector<RestingRun> out;
  const auto place = [&](double at_s) {
    return static_cast<std::size_t>(std::lower_bound(t_s.begin(), t_s.end(), at_s) - t_s.begin());
  };
  for (std::size_t first = 0; first < t_s.size();) {
    std::size_t last = first;
    // A hole in the data ends a rest: cells without a sample would take the next one's.
    while (last < t_s.size() && resting[last] != 0 && (last == first || t_s[last] - t_s[last - 1] <= kLongestStep_s))
      ++last;
    if (last > first + 1 && t_s[last - 1] - t_s[first] >= kShortest_s)
      out.push_back({place(t_s[first] + kEnds_s), place(t_s[last - 1] - kEnds_s)});
    first = std::max(last, first + 1);
  }
  return out;
}

struct Bin {
  double frequency_Hz = 0.0;
  std::complex<double> accel, press;  // of the acceleration and of the force's second derivative
  double density = 0.0;               // of the acceleration, one-sided
};

// Means over 1/50 s, the mean of all taken off, tapered.
std::vector<double> tapered(std::vector<double> x) {
  const auto n = static_cast<double>(x.size());
  double mean = 0.0;
  for (const double v : x) mean += v / n;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double a = 2.0 * std::numbers::pi * (static_cast<double>(i) + 0.5) / n;
    x[i] = (x[i] - mean) * 0.5 * (1.0 - std::cos(a));
  }
  return x;
}

struct Cells {
  std::vector<double> accel_mps2, force_N;
  double rate_Hz = 0.0;
};

Cells cells_of(std::span<const double> t_s, std::span<const double> accel_mps2, std::span<const double> force_N) {
  Cells out;
  const double duration_s = t_s.back() - t_s.front();
  const auto cells = static_cast<std::size_t>(duration_s * kRate_Hz);
  out.rate_Hz = static_cast<double>(cells) / duration_s;
  std::size_t i = 0;
  for (std::size_t c = 0; c < cells; ++c) {
    const double limit_s = t_s.front() + static_cast<double>(c + 1) / out.rate_Hz;
    double a = 0.0, f = 0.0, count = 0.0, forces = 0.0;
    for (; i < t_s.size() && (t_s[i] < limit_s || count == 0.0); ++i) {
      a += accel_mps2[i];
      count += 1.0;
      if (force_N.empty() || !std::isfinite(force_N[i])) continue;
      f += force_N[i];
      forces += 1.0;
    }
    if (count == 0.0) return {};
    out.accel_mps2.push_back(a / count);
    if (forces > 0.0) out.force_N.push_back(f / forces);
  }
  if (out.force_N.size() != out.accel_mps2.size()) out.force_N.clear();
  return out;
}

void add_bins(const Cells& cells, std::vector<Bin>& out) {
  const std::size_t n = cells.accel_mps2.size();
  std::vector<double> press(n, 0.0);
  for (std::size_t i = 1; i + 1 < n && !cells.force_N.empty(); ++i) {
    press[i] = (cells.force_N[i - 1] - 2.0 * cells.force_N[i] + cells.force_N[i + 1]) * cells.rate_Hz * cells.rate_Hz;
  }
  const auto accel = real_dft(tapered(cells.accel_mps2)), pressed = real_dft(tapered(press));
  for (std::size_t k = kFirstBin; k < accel.size(); ++k) {
    const double frequency_Hz = static_cast<double>(k) * cells.rate_Hz / static_cast<double>(n);
    if (frequency_Hz < kLowest_Hz || frequency_Hz > kHighest_Hz) continue;
    // One-sided: twice the power over the taper's, whose mean square is 3/8.
    const double scale = std::sqrt(2.0 / (0.375 * static_cast<double>(n) * cells.rate_Hz));
    out.push_back({frequency_Hz, scale * accel[k], scale * pressed[k], 0.0});
  }
}

// What the model says that a tip shows which stands still: no crosstalk, and no object that moves.
double density_at_rest(HeightErrors errors, double white_m2ps3, double corner_Hz, double frequency_Hz) {
  errors.accel_psd_m2ps3 = white_m2ps3;
  errors.accel_corner_Hz = corner_Hz;
  return std::pow(2.0 * std::numbers::pi * frequency_Hz, 4) * height_error_density_m2ps(errors, frequency_Hz);
}

HeightErrors without_motion(HeightErrors errors) {
  errors.crosstalk_Hz.clear();
  errors.crosstalk_m2ps.clear();
  errors.leaning_m2ps.clear();
  errors.object.clear();
  return errors;
}

// Takes off what the force's variation does, and leaves the densities.
void take_off_force(const HeightErrors& errors, double white_m2ps3, std::vector<Bin>& bins) {
  double cross = 0.0, power = 0.0;
  for (const Bin& bin : bins) {
    const double expected = density_at_rest(errors, white_m2ps3, NoiseAtRest{}.corner_Hz, bin.frequency_Hz);
    cross -= std::real(std::conj(bin.press) * bin.accel) / expected;
    power += std::norm(bin.press) / expected;
  }
  const double compliance = power > 0.0 ? std::max(0.0, cross / power) : 0.0;
  for (Bin& bin : bins) bin.density = std::norm(bin.accel + compliance * bin.press);
}

// The bins of all rests in one direction.
std::vector<Bin> bins_of(std::span<const double> t_s, std::span<const double> force_N,
                         const std::vector<RestingRun>& rests, const AccelerationAtRest& direction,
                         double white_m2ps3) {
  std::vector<Bin> out;
  for (const RestingRun& rest : rests) {
    const std::size_t count = rest.last - rest.first;
    const Cells cells =
        cells_of(t_s.subspan(rest.first, count), std::span(direction.accel_mps2).subspan(rest.first, count),
                 force_N.empty() ? force_N : force_N.subspan(rest.first, count));
    if (!cells.accel_mps2.empty()) add_bins(cells, out);
  }
  std::erase_if(out, [&](const Bin& bin) {
    const double omega = 2.0 * std::numbers::pi * bin.frequency_Hz;
    const double noise = white_m2ps3 + direction.errors.accel_walk_psd_m2ps5 / (omega * omega);
    return !(direction.errors.tracker_psd_m2ps * std::pow(omega, 4) >= kLeastInertial * noise);
  });
  take_off_force(direction.errors, white_m2ps3, out);
  return out;
}

// The mean of exponentials, as a logarithm.
double log_mean(const std::array<double, kMotions>& logarithms) {
  const double most = *std::max_element(logarithms.begin(), logarithms.end());
  double sum = 0.0;
  for (const double x : logarithms) sum += std::exp(x - most) / kMotions;
  return most + std::log(sum);
}

// The log-likelihood of a direction, its motion's power integrated over.
double log_likelihood(const std::vector<Bin>& bins, const HeightErrors& errors, double white_m2ps3, double corner_Hz,
                      double motion_unit_m2ps3) {
  std::vector<double> expected;
  for (const Bin& bin : bins) expected.push_back(density_at_rest(errors, white_m2ps3, corner_Hz, bin.frequency_Hz));
  const auto with_motion = [&](double motion) {
    double sum = 0.0;
    for (std::size_t i = 0; i < bins.size(); ++i) {
      const double s = expected[i] + motion * std::pow(bins[i].frequency_Hz / kMotion_Hz, 2);
      sum -= std::log(s) + bins[i].density / s;
    }
    return sum / kTaperVariance;
  };
  std::array<double, kMotions> moving{};
  for (int m = 0; m < kMotions; ++m) {
    const double decades = kMotionDecades * (2.0 * m / (kMotions - 1) - 1.0);
    moving[static_cast<std::size_t>(m)] = with_motion(motion_unit_m2ps3 * std::pow(10.0, decades));
  }
  const double still = with_motion(0.0), some = log_mean(moving), most = std::max(still, some);
  return most + std::log(0.5 * (std::exp(still - most) + std::exp(some - most)));
}

}  // namespace

NoiseAtRest noise_at_rest(std::span<const double> t_s, std::span<const double> force_N, std::span<const char> resting,
                          std::span<const AccelerationAtRest> directions, double white_m2ps3) {
  const std::size_t n = t_s.size();
  bool equal = resting.size() == n && (force_N.empty() || force_N.size() == n);
  for (const AccelerationAtRest& direction : directions) equal = equal && direction.accel_mps2.size() == n;
  if (!equal) throw Error("static noise: times, samples and marks differ in size (" + std::to_string(n) + " times)");
  NoiseAtRest out;
  const std::vector<RestingRun> rests = find_rests(t_s, resting);
  if (!(white_m2ps3 > 0.0) || rests.empty()) return out;
  std::vector<HeightErrors> still;
  std::vector<std::vector<Bin>> bins;
  std::size_t count = 0;
  for (const AccelerationAtRest& direction : directions) {
    still.push_back(without_motion(direction.errors));
    bins.push_back(bins_of(t_s, force_N, rests, direction, white_m2ps3));
    count += bins.back().size();
  }
  if (count == 0) return out;

  struct Node {
    double corner_Hz, log_weight;
  };
  std::vector<Node> nodes;
  double most = -std::numeric_limits<double>::infinity();
  for (int c = 0; c < kCorners; ++c) {
    const double z = -3.0 + 6.0 * c / (kCorners - 1);
    const double corner_Hz = kMiddle_Hz * std::exp(kSpread * z);
    for (int w = 0; w < kWhites; ++w) {
      const double y = -2.4 + 4.8 * w / (kWhites - 1);
      // The 1/f noise is that of the stated white noise, whatever the white noise is.
      const double share = std::exp(kWhiteSpread * y);
      double sum = -0.5 * (z * z + y * y);
      for (std::size_t d = 0; d < bins.size(); ++d)
        sum += log_likelihood(bins[d], still[d], white_m2ps3 * share, corner_Hz / share, white_m2ps3);
      nodes.push_back({corner_Hz, sum});
      most = std::max(most, sum);
    }
  }
  double weights = 0.0, sum = 0.0, square = 0.0;
  for (const Node& node : nodes) {
    const double weight = std::exp(node.log_weight - most);
    weights += weight;
    sum += weight * node.corner_Hz;
    square += weight * node.corner_Hz * node.corner_Hz;
  }
  for (const RestingRun& rest : rests) out.rests_s += t_s[rest.last - 1] - t_s[rest.first];
  out.corner_Hz = sum / weights;
  out.corner_sigma_Hz = std::sqrt(std::max(0.0, square / weights - out.corner_Hz * out.corner_Hz));
  return out;
}

}  // namespace asperity
