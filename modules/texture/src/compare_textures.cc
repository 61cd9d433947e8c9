#include "asperity/texture/compare_textures.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/signal/resample.h"
#include "asperity/signal/spectrum.h"
#include "asperity/signal/zero_phase.h"

namespace asperity {
namespace {

void check_spacing(double spacing_m) {
  if (!(spacing_m > 0.0) || !std::isfinite(spacing_m))
    throw Error("compare: the spacing " + number_text(spacing_m) + " m is not a positive length");
}

double band_end(double spacing_m, const CompareTexturesConfig& config) {
  return std::min(config.high_cycles_per_mm, 0.45e-3 / spacing_m);
}

// Welch's density over cycles/mm, averaged over the lines, and how many segments that took.
struct Spectrum {
  std::vector<double> frequency;
  std::vector<double> density;
  double step = 0.0;
  double segments = 0.0;

  double variance(double low, double high) const {
    double sum = 0.0;
    for (std::size_t k = 0; k < frequency.size(); ++k) {
      // The part of the bin that lies in the band, so that bands share no power and lose none.
      const double from = std::max(low, frequency[k] - 0.5 * step);
      const double to = std::min(high, frequency[k] + 0.5 * step);
      if (to > from) sum += density[k] * (to - from);
    }
    return sum;
  }

  double mean_frequency(double low, double high) const {
    double sum = 0.0;
    double weight = 0.0;
    for (std::size_t k = 0; k < frequency.size(); ++k) {
      if (frequency[k] < low || frequency[k] > high) continue;
      sum += frequency[k] * density[k];
      weight += density[k];
    }
    return weight > 0.0 ? sum / weight : std::numeric_limits<double>::quiet_NaN();
  }
};

Spectrum spectrum_of(const ComparedSurface& surface, double segment_mm) {
  check_spacing(surface.spacing_m);
  if (surface.lines_m.empty()) throw Error("compare: a surface without a line of heights");
  const double rate = 1e-3 / surface.spacing_m;
  std::size_t shortest = surface.lines_m.front().size();
  for (const auto& line : surface.lines_m) shortest = std::min(shortest, line.size());
  if (shortest < 16) throw Error("compare: a line of " + std::to_string(shortest) + " heights; 16 are needed");
  const double wanted = std::clamp(std::round(segment_mm * rate), 16.0, static_cast<double>(shortest));
  Spectrum result;
  for (const auto& line : surface.lines_m) {
    const PowerSpectrum one = welch(line, rate, static_cast<std::size_t>(wanted));
    if (result.density.empty()) {
      result.frequency = one.frequency;
      result.density.assign(one.density.size(), 0.0);
    }
    for (std::size_t k = 0; k < one.density.size(); ++k)
      result.density[k] += one.density[k] / static_cast<double>(surface.lines_m.size());
    result.segments += static_cast<double>(one.segments);
  }
  result.step = result.frequency[1] - result.frequency[0];
  return result;
}

Difference difference(double a, double b, double jnd_percent) {
  Difference d{a, b, 0.0, jnd_percent, false};
  if (a != b) d.percent = 100.0 * (b - a) / std::abs(a);
  d.noticeable = std::abs(d.percent) > jnd_percent;
  return d;
}

}  // namespace

double just_noticeable_percent(double frequency_Hz) {
  constexpr double kLow_Hz = 250.0, kHigh_Hz = 300.0, kLow_percent = 3.0, kHigh_percent = 18.0;
  const double part = std::clamp((frequency_Hz - kLow_Hz) / (kHigh_Hz - kLow_Hz), 0.0, 1.0);
  return kLow_percent + part * (kHigh_percent - kLow_percent);
}

std::vector<double> band_limited_heights(const std::vector<double>& height_m, double spacing_m,
                                         const CompareTexturesConfig& config) {
  check_spacing(spacing_m);
  const std::vector<double> bridged = bridge_gaps(height_m);
  if (bridged.empty() || std::isnan(bridged.front())) throw Error("compare: a line without heights");
  const double high = band_end(spacing_m, config);
  if (!(config.low_cycles_per_mm < high)) {
    throw Error("compare: the band from " + number_text(config.low_cycles_per_mm) + " to " + number_text(high) +
                " cycles/mm is empty");
  }
  return zero_phase_bandpass(bridged, config.low_cycles_per_mm, high, 1e-3 / spacing_m);
}

TextureComparison compare_textures(const ComparedSurface& a, const ComparedSurface& b,
                                   const CompareTexturesConfig& config) {
  const Spectrum spectrum_a = spectrum_of(a, config.segment_mm);
  const Spectrum spectrum_b = spectrum_of(b, config.segment_mm);
  TextureComparison result;
  result.low_cycles_per_mm = config.low_cycles_per_mm;
  result.high_cycles_per_mm = std::min(band_end(a.spacing_m, config), band_end(b.spacing_m, config));
  const double low = result.low_cycles_per_mm;
  const double high = result.high_cycles_per_mm;
  if (!(low < high)) throw Error("compare: the surfaces have no band of frequencies in common");
  const auto jnd_at = [&](double cycles_per_mm) {
    return just_noticeable_percent(1e3 * cycles_per_mm * config.speed_mps);
  };
  const double whole_a = spectrum_a.variance(low, high);
  const double whole_b = spectrum_b.variance(low, high);
  const double least = config.least_part * config.least_part;
  for (double from = low; from < high * (1.0 - 1e-9);) {
    // A last band of less than half an octave joins the one before.
    const double to = 2.0 * from * std::sqrt(2.0) > high ? high : 2.0 * from;
    BandDifference band;
    band.low_cycles_per_mm = from;
    band.high_cycles_per_mm = to;
    const double variance_a = spectrum_a.variance(from, to);
    const double variance_b = spectrum_b.variance(from, to);
    band.rms_m = difference(std::sqrt(variance_a), std::sqrt(variance_b), jnd_at(std::sqrt(from * to)));
    band.is_compared = variance_a > least * whole_a || variance_b > least * whole_b;
    // A variance from n independent bins has the relative deviation √(1/n); Hann windows that overlap by half
    // leave about half of segments and bins independent.
    const auto deviation = [&](const Spectrum& s) {
      return 1.0 / std::max(1.0, 0.5 * s.segments * std::max(1.0, (to - from) / s.step));
    };
    band.uncertainty_percent = 50.0 * std::sqrt(deviation(spectrum_a) + deviation(spectrum_b));
    result.noticeable = result.noticeable || (band.is_compared && band.rms_m.noticeable);
    result.bands.push_back(band);
    from = to;
  }
  const double mean_a = spectrum_a.mean_frequency(low, high);
  result.frequency_per_mm = difference(mean_a, spectrum_b.mean_frequency(low, high), jnd_at(mean_a));
  for (const auto& [name, value] : a.roughness) {
    const auto found = b.roughness.find(name);
    if (found == b.roughness.end()) continue;
    Difference& d = result.roughness[name] = difference(value, found->second, jnd_at(mean_a));
    if (name == "Rq_m" || name == "RSm_m") result.noticeable = result.noticeable || d.noticeable;
  }
  return result;
}

}  // namespace asperity
