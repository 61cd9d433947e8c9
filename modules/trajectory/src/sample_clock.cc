#include "sample_clock.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <numbers>
#include <span>

namespace asperity {

namespace {

constexpr std::size_t kFewest = 20;
constexpr std::size_t kBlock = 128;        // stamps: a clock that wanders by 0.1 % keeps its phase over them
constexpr std::size_t kMostBlocks = 16;    // of the search
constexpr double kShortest = 0.7;          // of the mean step: up to 30 % of the samples lost
constexpr double kLongest = 1.05;          // of the mean step
constexpr double kPause = 20.0;            // of the median step: a longer step is no step of the mean
constexpr double kBinsPerFrequency = 8.0;  // of a block
constexpr double kByChance = 1e-3;
constexpr double kAsClear = 0.8;  // of the highest coherence: an alias is as high

struct Peak {
  double period_ns = 0.0;
  double coherence = 0.0;  // mean of |C|²/n over the blocks
};

std::complex<double> phase_sum(std::span<const double> since_ns, double period_ns) {
  const double omega = 2.0 * std::numbers::pi / period_ns;
  std::complex<double> sum = 0.0;
  for (const double t : since_ns) sum += std::polar(1.0, omega * (t - since_ns.front()));
  return sum;
}

std::vector<std::span<const double>> split_blocks(const std::vector<double>& since_ns) {
  std::vector<std::span<const double>> out;
  const std::size_t blocks = std::max<std::size_t>(1, since_ns.size() / kBlock);
  for (std::size_t b = 0; b < blocks; ++b) {
    const std::size_t first = b * since_ns.size() / blocks, last = (b + 1) * since_ns.size() / blocks;
    out.push_back(std::span(since_ns).subspan(first, last - first));
  }
  return out;
}

// The mean step, pauses left out.
double mean_step_ns(const std::vector<double>& since_ns) {
  std::vector<double> steps(since_ns.size() - 1);
  for (std::size_t i = 0; i < steps.size(); ++i) steps[i] = since_ns[i + 1] - since_ns[i];
  std::vector<double> sorted = steps;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  double sum = 0.0, count = 0.0;
  for (const double step : steps) {
    if (step > kPause * *middle) continue;
    sum += step;
    count += 1.0;
  }
  return sum / count;
}

// The local maxima of the coherence over the periods that the mean step allows, the longest period first.
std::vector<Peak> find_peaks(const std::vector<std::span<const double>>& blocks, double mean_ns) {
  const std::size_t stride = (blocks.size() + kMostBlocks - 1) / kMostBlocks;
  const double length_ns = static_cast<double>(blocks.front().size()) * mean_ns;
  const double lowest = 1.0 / (kLongest * mean_ns), highest = 1.0 / (kShortest * mean_ns);
  const double step = 1.0 / (kBinsPerFrequency * length_ns);
  std::vector<Peak> all;
  for (double frequency = lowest; frequency <= highest; frequency += step) {
    Peak& one = all.emplace_back();
    one.period_ns = 1.0 / frequency;
    double used = 0.0;
    for (std::size_t b = 0; b < blocks.size(); b += stride) {
      one.coherence += std::norm(phase_sum(blocks[b], one.period_ns)) / static_cast<double>(blocks[b].size());
      used += 1.0;
    }
    one.coherence /= used;
  }
  std::vector<Peak> out;
  for (std::size_t i = 1; i + 1 < all.size(); ++i) {
    if (all[i].coherence >= all[i - 1].coherence && all[i].coherence > all[i + 1].coherence) out.push_back(all[i]);
  }
  return out;
}

std::optional<double> find_period_ns(const std::vector<std::span<const double>>& blocks, double mean_ns) {
  const std::vector<Peak> peaks = find_peaks(blocks, mean_ns);
  double highest = 0.0;
  for (const Peak& peak : peaks) highest = std::max(highest, peak.coherence);
  const auto used = static_cast<double>(std::min(blocks.size(), kMostBlocks));
  const double tried = (1.0 / kShortest - 1.0 / kLongest) * static_cast<double>(blocks.front().size());
  // P(mean of `used` exponential variables of mean 1 > x) < exp(−used (x − 1 − ln x)).
  if (!(highest > 1.0) || used * (highest - 1.0 - std::log(highest)) < std::log(std::max(1.0, tried) / kByChance)) {
    return std::nullopt;
  }
  for (const Peak& peak : peaks) {
    if (peak.coherence >= kAsClear * highest) return peak.period_ns;
  }
  return std::nullopt;
}

// The clock's phase at the middle of each block, in periods of `period_ns` since the first stamp, without jumps.
struct Phases {
  std::vector<double> at_ns, late;
};

Phases follow_phase(const std::vector<std::span<const double>>& blocks, double period_ns) {
  Phases out;
  const double origin_ns = blocks.front().front();
  for (const std::span<const double> block : blocks) {
    const double whole = (block.front() - origin_ns) / period_ns;
    double late = std::arg(phase_sum(block, period_ns)) / (2.0 * std::numbers::pi) + whole - std::floor(whole);
    if (!out.late.empty()) late += std::round(out.late.back() - late);
    out.late.push_back(late);
    out.at_ns.push_back(0.5 * (block.front() + block.back()));
  }
  return out;
}

double slope(const Phases& phases) {
  const auto n = static_cast<double>(phases.late.size());
  double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  for (std::size_t i = 0; i < phases.late.size(); ++i) {
    x += phases.at_ns[i] / n;
    y += phases.late[i] / n;
  }
  for (std::size_t i = 0; i < phases.late.size(); ++i) {
    xx += (phases.at_ns[i] - x) * (phases.at_ns[i] - x);
    xy += (phases.at_ns[i] - x) * (phases.late[i] - y);
  }
  return xx > 0.0 ? xy / xx : 0.0;
}

double late_at(const Phases& phases, double at_ns, std::size_t& next) {
  while (next < phases.at_ns.size() && phases.at_ns[next] < at_ns) ++next;
  if (next == 0) return phases.late.front();
  if (next == phases.at_ns.size()) return phases.late.back();
  const double share = (at_ns - phases.at_ns[next - 1]) / (phases.at_ns[next] - phases.at_ns[next - 1]);
  return phases.late[next - 1] + share * (phases.late[next] - phases.late[next - 1]);
}

// The non-decreasing sequence nearest to x (pool adjacent violators).
std::vector<double> isotonic(const std::vector<double>& x) {
  struct Pool {
    double sum = 0.0, count = 0.0;
    double mean() const { return sum / count; }
  };
  std::vector<Pool> pools;
  for (const double value : x) {
    pools.push_back({value, 1.0});
    while (pools.size() > 1 && pools[pools.size() - 2].mean() >= pools.back().mean()) {
      const Pool last = pools.back();
      pools.pop_back();
      pools.back().sum += last.sum;
      pools.back().count += last.count;
    }
  }
  std::vector<double> out;
  out.reserve(x.size());
  for (const Pool& pool : pools) out.insert(out.end(), static_cast<std::size_t>(pool.count), pool.mean());
  return out;
}

}  // namespace

std::optional<SampleClock> find_sample_clock(const std::vector<std::int64_t>& t_ns) {
  if (t_ns.size() < kFewest) return std::nullopt;
  std::vector<double> since_ns(t_ns.size());
  for (std::size_t i = 0; i < t_ns.size(); ++i) since_ns[i] = static_cast<double>(t_ns[i] - t_ns[0]);
  const std::vector<std::span<const double>> blocks = split_blocks(since_ns);
  const std::optional<double> found_ns = find_period_ns(blocks, mean_step_ns(since_ns));
  if (!found_ns) return std::nullopt;
  SampleClock out;
  out.period_ns = *found_ns;
  // Of a phase that advances by s periods a ns, the period is 1/(1/T + s). Twice: the first slope is of a rough period.
  for (int k = 0; k < 2; ++k) out.period_ns /= 1.0 - slope(follow_phase(blocks, out.period_ns)) * out.period_ns;
  const Phases phases = follow_phase(blocks, out.period_ns);
  std::vector<double> lost(t_ns.size());
  std::size_t next = 0;
  for (std::size_t i = 0; i < lost.size(); ++i) {
    lost[i] = since_ns[i] / out.period_ns - late_at(phases, since_ns[i], next) - static_cast<double>(i);
  }
  lost = isotonic(lost);
  out.count.resize(lost.size());
  for (std::size_t i = 0; i < lost.size(); ++i) {
    out.count[i] = static_cast<double>(i) + std::round(lost[i]) - std::round(lost[0]);
  }
  return out;
}

}  // namespace asperity
