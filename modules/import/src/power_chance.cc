#include "power_chance.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "asperity/base/random.h"
#include "asperity/signal/spectrum.h"
#include "asperity/signal/student.h"

namespace asperity {

namespace {

// Logarithms of powers above 0: their mean, the sum of the squares about it, and what windows side by side have in
// common.
struct LogPowers {
  double count = 0.0, mean = 0.0, squares = 0.0;
  double neighbours = 0.0, products = 0.0;

  explicit LogPowers(const WindowPowers& of) {
    std::vector<double> logs;
    std::vector<std::size_t> first;
    for (std::size_t i = 0; i < of.power.size(); ++i) {
      if (!(of.power[i] > 0.0)) continue;
      logs.push_back(std::log(of.power[i]));
      first.push_back(of.first[i]);
    }
    count = static_cast<double>(logs.size());
    mean = std::accumulate(logs.begin(), logs.end(), 0.0) / count;
    for (const double l : logs) squares += (l - mean) * (l - mean);
    for (std::size_t i = 1; i < logs.size(); ++i) {
      if (first[i] != first[i - 1] + of.length) continue;
      neighbours += 1.0;
      products += (logs[i] - mean) * (logs[i - 1] - mean);
    }
  }
};

// By how much fewer the windows count: their estimated correlation is too low by about 1/n.
double share_of_windows(double squares, double count, double products, double neighbours) {
  if (!(squares > 0.0) || neighbours < 1.0) return 1.0;
  constexpr double kMost = 0.95;
  const double r = std::clamp(products / neighbours / (squares / count) + 1.0 / count, 0.0, kMost);
  return (1.0 - r) / (1.0 + r);
}

double one_sided(double t, double freedom) {
  if (!(t > 0.0)) return 1.0;
  return 0.5 * student_two_sided(t, std::max(1.0, freedom));
}

bool is_silent(double power) { return !(power > 0.0); }

// Marsaglia and Tsang 2000; the mean is the shape.
double gamma_deviate(double shape, Random& random) {
  const double boost = shape < 1.0 ? std::pow(1.0 - random.uniform(), 1.0 / shape) : 1.0;
  const double d = (shape < 1.0 ? shape + 1.0 : shape) - 1.0 / 3.0, c = 1.0 / std::sqrt(9.0 * d);
  while (true) {
    const double z = random.normal(), v = std::pow(1.0 + c * z, 3);
    if (v > 0.0 && std::log(1.0 - random.uniform()) < 0.5 * z * z + d - d * v + d * std::log(v)) return boost * d * v;
  }
}

}  // namespace

double power_chance(const WindowPowers& active, const WindowPowers& quiet) {
  if (std::any_of(active.power.begin(), active.power.end(), is_silent)) return 1.0;
  // A sensor that repeats itself for a moment is silent in some quiet windows; the others show its noise.
  if (std::all_of(quiet.power.begin(), quiet.power.end(), is_silent)) return 0.0;
  const LogPowers a(active), q(quiet);
  const double difference = a.mean - q.mean, each = 1.0 / a.count + 1.0 / q.count;
  const double windows = a.count + q.count, squares = a.squares + q.squares;
  const double share = share_of_windows(squares, windows, a.products + q.products, a.neighbours + q.neighbours);
  const double freedom = share * (windows - 2.0);
  const double of_both = one_sided(difference / std::sqrt(squares / (windows - 2.0) * each / share), freedom);
  double of_quiet = 1.0;
  if (q.count > 2.0) {
    const double own = share_of_windows(q.squares, q.count, q.products, q.neighbours);
    of_quiet = one_sided(difference / std::sqrt(q.squares / (q.count - 1.0) * each / own), own * (q.count - 1.0));
  }
  return std::min(1.0, 2.0 * std::min(of_both, of_quiet));
}

double power_chance(const WindowPowers& active, double noise_power) {
  if (std::any_of(active.power.begin(), active.power.end(), is_silent)) return 1.0;
  if (!(noise_power > 0.0)) return 0.0;
  const LogPowers a(active);
  const double share = share_of_windows(a.squares, a.count, a.products, a.neighbours);
  // The mean of a power's logarithm is below the logarithm of its mean: the latter is what noise is stated by.
  double mean = 0.0;
  for (const double p : active.power) mean += p / a.count;
  const double scatter = a.squares / (a.count - 1.0);
  return one_sided(std::log(mean / noise_power) / std::sqrt(scatter / a.count / share), share * (a.count - 1.0));
}

double quietest_chance(double ratio, std::size_t windows, std::size_t quietest, double freedom) {
  if (!(ratio > 1.0)) return 1.0;
  if (!std::isfinite(ratio)) return 0.0;
  constexpr int kDraws = 400;
  Random random(1);
  std::vector<double> one(windows);
  double sum = 0.0, squares = 0.0;
  for (int draw = 0; draw < kDraws; ++draw) {
    for (double& p : one) p = gamma_deviate(0.5 * freedom, random);
    std::sort(one.begin(), one.end());
    const auto low = one.begin() + static_cast<std::ptrdiff_t>(quietest);
    const auto half = one.begin() + static_cast<std::ptrdiff_t>(windows / 2);
    const double quiet = std::accumulate(one.begin(), low, 0.0) / static_cast<double>(quietest);
    const double loud = std::accumulate(half, one.end(), 0.0) / static_cast<double>(one.end() - half);
    const double log_ratio = std::log(loud / quiet);
    sum += log_ratio;
    squares += log_ratio * log_ratio;
  }
  const double mean = sum / kDraws;
  const double sigma = std::sqrt(std::max(0.0, squares / kDraws - mean * mean) * kDraws / (kDraws - 1.0));
  return one_sided((std::log(ratio) - mean) / (sigma * std::sqrt(1.0 + 1.0 / kDraws)), kDraws - 1.0);
}

double power_freedom(std::span<const double> x, double rate_Hz, double window_s) {
  constexpr double kSegment_s = 0.25;
  const auto segment = static_cast<std::size_t>(std::round(kSegment_s * rate_Hz));
  const PowerSpectrum spectrum = welch(x, rate_Hz, segment);
  const double step = spectrum.frequency[1] - spectrum.frequency[0];
  double power = 0.0, squares = 0.0;
  for (const double s : spectrum.density) {
    power += s * step;
    squares += s * s * step;
  }
  // The square of an estimate of n segments is too large by 1/n of it.
  squares /= 1.0 + 1.0 / static_cast<double>(spectrum.segments);
  return squares > 0.0 ? std::max(1.0, 2.0 * window_s * power * power / squares) : 1.0;
}

}  // namespace asperity
