#include "asperity/profile/measure_error_floor.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/signal/chi_square.h"
#include "asperity/signal/spectrum.h"

namespace asperity {

namespace {

constexpr double kFloorSegment_s = 0.16;
constexpr std::size_t kFewest_samples = 32;
constexpr double kLowestFloor_Hz = 12.0;
constexpr double kFloorWidth = 1.2599;  // a third of an octave
constexpr double kPositionSegment_s = 1.3;
constexpr double kLowestPosition_Hz = 1.6, kHighestPosition_Hz = 50.0;
constexpr double kLowByChance = 0.01;  // of each of the five octaves
constexpr double kPause_s = 0.05;
constexpr double kLostStep = 1.5;  // of the period, of a smoothed clock
constexpr double kLost = 2.2;      // of the period: a longer step has lost samples, however its stamps jitter

struct Run {
  std::size_t first = 0, last = 0;
};

// The mean step among those that are not gaps: stamps in whole milliseconds or in batches have a median of their own.
double usual_period_s(std::span<const double> t_s) {
  double sum_s = 0.0, count = 0.0;
  for (std::size_t i = 1; i < t_s.size(); ++i) {
    const double step_s = t_s[i] - t_s[i - 1];
    if (step_s > kPause_s) continue;
    sum_s += step_s;
    count += 1.0;
  }
  return count > 0.0 ? sum_s / count : 0.0;
}

// The runs of usable samples without a step longer than `longest_step_s`.
std::vector<Run> find_runs(std::span<const double> t_s, std::span<const double> x, std::span<const char> usable,
                           double longest_step_s) {
  if (x.size() != t_s.size() || (!usable.empty() && usable.size() != t_s.size())) {
    throw Error("error floor: times, samples and marks differ in size (" + std::to_string(t_s.size()) + " times)");
  }
  std::vector<Run> out;
  for (std::size_t i = 0; i < t_s.size(); ++i) {
    if ((!usable.empty() && usable[i] == 0) || !std::isfinite(x[i])) continue;
    const bool goes_on = !out.empty() && out.back().last == i && t_s[i] - t_s[i - 1] <= longest_step_s;
    if (!goes_on) out.push_back({i, i});
    out.back().last = i + 1;
  }
  return out;
}

// Welch's spectrum over all runs that hold a segment, weighted by their segments.
PowerSpectrum mean_spectrum(std::span<const double> x, const std::vector<Run>& runs, double rate_Hz,
                            std::size_t segment) {
  PowerSpectrum out;
  for (const Run& run : runs) {
    if (run.last - run.first < segment) continue;
    const PowerSpectrum one = welch(x.subspan(run.first, run.last - run.first), rate_Hz, segment);
    if (out.segments == 0) {
      out.frequency = one.frequency;
      out.density.assign(one.density.size(), 0.0);
    }
    const auto weight = static_cast<double>(one.segments);
    for (std::size_t i = 0; i < out.density.size(); ++i) out.density[i] += weight * one.density[i];
    out.segments += one.segments;
  }
  for (double& d : out.density) d /= static_cast<double>(out.segments);
  return out;
}

// The octave's mean of the density and of that times (2πf)⁴, which is that of the second derivative.
struct Octave {
  double density = 0.0;
  double acceleration = 0.0;
  double lines = 0.0;  // of the spectrum
};

// The octaves that hold a line, from `highest_Hz` down to `lowest_Hz`.
std::vector<Octave> octaves(const PowerSpectrum& spectrum, double lowest_Hz, double highest_Hz, double width) {
  std::vector<Octave> out;
  for (double high = highest_Hz; high > 0.999 * width * lowest_Hz; high /= width) {
    Octave octave;
    double count = 0.0;
    for (std::size_t i = 1; i < spectrum.frequency.size(); ++i) {
      if (spectrum.frequency[i] < high / width || spectrum.frequency[i] > high) continue;
      const double omega = 2.0 * std::numbers::pi * spectrum.frequency[i];
      octave.density += spectrum.density[i];
      octave.acceleration += spectrum.density[i] * omega * omega * omega * omega;
      count += 1.0;
    }
    if (count > 0.0) out.push_back({octave.density / count, octave.acceleration / count, count});
  }
  return out;
}

// Welch's spectrum of the acceleration up to half the sampling rate; none without a run that is long enough.
PowerSpectrum acceleration_spectrum(std::span<const double> t_s, std::span<const double> accel_mps2,
                                    std::span<const char> usable) {
  if (t_s.size() < kFewest_samples) return {};
  const double period_s = usual_period_s(t_s);
  if (!(period_s > 0.0)) return {};
  const std::vector<Run> runs = find_runs(t_s, accel_mps2, usable, kLost * period_s);
  const auto segment = std::max(kFewest_samples, static_cast<std::size_t>(std::lround(kFloorSegment_s / period_s)));
  PowerSpectrum spectrum = mean_spectrum(accel_mps2, runs, 1.0 / period_s, segment);
  // Stamps of batches tell of no single sample whether it was lost: the few that were raise the floor a little.
  if (spectrum.segments == 0) {
    spectrum = mean_spectrum(accel_mps2, find_runs(t_s, accel_mps2, usable, kPause_s), 1.0 / period_s, segment);
  }
  return spectrum;
}

// The mean square of the velocity's error, (m/s)², that a straight line over so many lost samples would leave.
double square_of_gap(std::span<const double> accel_mps2, const std::vector<Run>& runs, std::size_t lost,
                     double period_s) {
  double sum = 0.0, count = 0.0;
  for (const Run& run : runs) {
    if (run.last - run.first < lost + 2) continue;
    double between = 0.0;
    for (std::size_t j = 1; j <= lost; ++j) between += accel_mps2[run.first + j];
    for (std::size_t i = run.first; i + lost + 1 < run.last; ++i) {
      const double line = 0.5 * static_cast<double>(lost) * (accel_mps2[i] + accel_mps2[i + lost + 1]);
      sum += std::pow(period_s * (between - line), 2);
      count += 1.0;
      between += accel_mps2[i + lost + 1] - accel_mps2[i + 1];
    }
  }
  return count > 0.0 ? sum / count : 0.0;
}

}  // namespace

double acceleration_floor_m2ps3(std::span<const double> t_s, std::span<const double> accel_mps2,
                                std::span<const char> usable) {
  const PowerSpectrum spectrum = acceleration_spectrum(t_s, accel_mps2, usable);
  if (spectrum.segments == 0) return 0.0;
  double lowest = std::numeric_limits<double>::infinity();
  for (const Octave& octave : octaves(spectrum, kLowestFloor_Hz, spectrum.frequency.back(), kFloorWidth)) {
    lowest = std::min(lowest, octave.density);
  }
  return std::isfinite(lowest) ? lowest : 0.0;
}

double folded_acceleration_m2ps3(std::span<const double> t_s, std::span<const double> accel_mps2,
                                 std::span<const char> usable) {
  const PowerSpectrum spectrum = acceleration_spectrum(t_s, accel_mps2, usable);
  if (spectrum.segments == 0) return 0.0;
  const double highest_Hz = spectrum.frequency.back();
  const std::vector<Octave> top = octaves(spectrum, highest_Hz / (2.0 * kFloorWidth), highest_Hz, kFloorWidth);
  if (top.size() < 4 || !(top[3].density > 0.0)) return top.empty() ? 0.0 : top.front().density;
  return top[0].density * std::min(1.0, top[0].density / top[3].density);
}

double gap_noise_m2ps3(std::span<const double> t_s, std::span<const double> accel_mps2, std::span<const char> usable,
                       std::size_t replaced) {
  if (t_s.size() < kFewest_samples) return 0.0;
  const double period_s = usual_period_s(t_s);
  if (!(period_s > 0.0)) return 0.0;
  const auto is_usable = [&](std::size_t i) { return usable.empty() || usable[i] != 0; };
  std::map<std::size_t, double> gaps;  // by the number of lost samples
  double seen_s = 0.0;
  for (std::size_t i = 1; i < t_s.size(); ++i) {
    const double step_s = t_s[i] - t_s[i - 1];
    if (!is_usable(i) || !is_usable(i - 1) || step_s > kPause_s) continue;
    seen_s += step_s;
    const auto lost = static_cast<std::size_t>(std::max(0L, std::lround(step_s / period_s) - 1));
    if (lost > 0) gaps[lost] += 1.0;
  }
  if (!(seen_s > 0.0)) return 0.0;
  if (replaced > 0) gaps[1] += static_cast<double>(replaced) * seen_s / (t_s.back() - t_s.front());
  const std::vector<Run> runs = find_runs(t_s, accel_mps2, usable, kLostStep * period_s);
  double sum = 0.0;
  for (const auto& [lost, count] : gaps) sum += count * square_of_gap(accel_mps2, runs, lost, period_s);
  return 2.0 * sum / seen_s;
}

double largest_acceleration_noise_m2ps3(std::span<const double> t_s, std::span<const double> position_m,
                                        std::span<const char> usable, double tracker_psd_m2ps) {
  double largest = std::numeric_limits<double>::infinity();
  if (t_s.size() < kFewest_samples || position_m.empty() || !(tracker_psd_m2ps > 0.0)) return largest;
  const double period_s = usual_period_s(t_s);
  if (!(period_s > 0.0)) return largest;
  // A short gap does no harm to a position at these frequencies: it moves little in it.
  const std::vector<Run> runs = find_runs(t_s, position_m, usable, kPause_s);
  const auto segment = static_cast<std::size_t>(std::lround(kPositionSegment_s / period_s));
  if (segment < kFewest_samples) return largest;
  const PowerSpectrum spectrum = mean_spectrum(position_m, runs, 1.0 / period_s, segment);
  if (spectrum.segments < 2) return largest;
  for (const Octave& octave : octaves(spectrum, kLowestPosition_Hz, kHighestPosition_Hz, 2.0)) {
    // By chance the density is this much lower than its expectation. Hann windows correlate neighbouring lines: a line
    // of a segment counts as half.
    const double freedom = std::max(2.0, octave.lines * static_cast<double>(spectrum.segments));
    const double chance = freedom / chi_square_quantile(kLowByChance, freedom);
    const double share = chance * octave.density / tracker_psd_m2ps;
    if (share < 1.0) largest = std::min(largest, chance * octave.acceleration / (1.0 - share));
  }
  return largest;
}

}  // namespace asperity
