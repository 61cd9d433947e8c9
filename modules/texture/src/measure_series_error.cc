#include <algorithm>
#include <cmath>
#include <string>

#include "asperity/base/error.h"
#include "asperity/signal/spectrum.h"
#include "asperity/texture/evaluate_autoregressive.h"
#include "asperity/texture/fit_autoregressive.h"
#include "series_windows.h"

namespace asperity {
namespace {

struct Stretch {
  std::size_t first = 0;
  std::size_t count = 0;
};

std::vector<Stretch> stretches(const std::vector<SeriesWindow>& windows) {
  std::vector<Stretch> runs;
  for (const auto& w : windows) {
    if (!runs.empty() && runs.back().first + runs.back().count == w.first)
      runs.back().count += w.count;
    else
      runs.push_back({w.first, w.count});
  }
  return runs;
}

// Power a band, weighted by the stretches' lengths. The bands part the range from the high-pass to half the rate
// evenly.
std::vector<double> band_powers(std::span<const double> x, const std::vector<Stretch>& runs, std::size_t segment,
                                double rate_Hz, const std::vector<double>& band_Hz, double low_Hz) {
  std::vector<double> power(band_Hz.size(), 0.0);
  double weight = 0.0;
  for (const auto& run : runs) {
    if (run.count < segment) continue;
    const auto spectrum = welch(x.subspan(run.first, run.count), rate_Hz, segment);
    const double step = spectrum.frequency[1];
    const double n = static_cast<double>(run.count);
    for (std::size_t i = 0; i < spectrum.frequency.size(); ++i) {
      const double f = spectrum.frequency[i];
      if (f < low_Hz) continue;
      const auto band = std::lower_bound(band_Hz.begin(), band_Hz.end(), f) - band_Hz.begin();
      power[std::min(static_cast<std::size_t>(band), power.size() - 1)] += n * spectrum.density[i] * step;
    }
    weight += n;
  }
  for (double& p : power) p /= std::max(weight, 1.0);
  return power;
}

double variance_of(std::span<const double> x, const std::vector<Stretch>& runs) {
  double square = 0.0;
  double count = 0.0;
  for (const auto& run : runs) {
    for (std::size_t i = run.first; i < run.first + run.count; ++i) square += x[i] * x[i];
    count += static_cast<double>(run.count);
  }
  return square / std::max(count, 1.0);
}

}  // namespace

SeriesError measure_series_error(const AutoregressiveTexture& texture, const SeriesRecording& recording,
                                 const FitAutoregressiveConfig& config) {
  check_recording(recording);
  const auto runs = stretches(stroking_windows(recording, config));
  if (runs.empty()) throw Error("texture: the recording does not stroke");
  const auto x = vibration_mps2(recording, config);
  SeriesError error;
  for (const auto& run : runs) error.samples += run.count;
  error.recorded_variance = variance_of(x, runs);
  const double high_Hz = 0.5 * recording.rate_Hz;
  const double low_Hz = std::min(config.high_pass_Hz, 0.5 * high_Hz);
  for (int i = 1; i <= config.bands; ++i) error.band_Hz.push_back(low_Hz + (high_Hz - low_Hz) * i / config.bands);
  std::size_t longest = 0;
  for (const auto& run : runs) longest = std::max(longest, run.count);
  const std::size_t segment = std::min<std::size_t>(longest, 256);
  error.recorded_power = band_powers(x, runs, segment, recording.rate_Hz, error.band_Hz, low_Hz);

  error.synthesised_power.assign(error.band_Hz.size(), 0.0);
  double variance = 0.0;
  std::vector<double> y(x.size());
  const double dt_s = 1.0 / recording.rate_Hz;
  for (int realisation = 0; realisation < config.realisations; ++realisation) {
    SeriesState state = start_series(static_cast<std::uint64_t>(config.seed), static_cast<std::uint64_t>(realisation));
    for (std::size_t i = 0; i < y.size(); ++i)
      y[i] = next_acceleration_mps2(texture, state, recording.speed_mps[i], recording.force_N[i], dt_s);
    // What the recording has gone through, the synthesis goes through too.
    const auto filtered = vibration_mps2({y, recording.speed_mps, recording.force_N, recording.rate_Hz}, config);
    variance += variance_of(filtered, runs) / config.realisations;
    const auto power = band_powers(filtered, runs, segment, recording.rate_Hz, error.band_Hz, low_Hz);
    for (std::size_t b = 0; b < power.size(); ++b) error.synthesised_power[b] += power[b] / config.realisations;
  }
  error.variance_error = error.recorded_variance > 0.0 ? variance / error.recorded_variance - 1.0 : 0.0;
  double total = 0.0;
  double difference = 0.0;
  for (const double p : error.recorded_power) total += p;
  for (std::size_t b = 0; b < error.band_Hz.size(); ++b) {
    const double p = error.recorded_power[b];
    const double d = std::abs(error.synthesised_power[b] - p);
    difference += d;
    if (p >= 0.02 * total && p > 0.0) error.worst_band_error = std::max(error.worst_band_error, d / p);
  }
  if (total > 0.0) error.spectrum_error = difference / total;
  return error;
}

}  // namespace asperity
