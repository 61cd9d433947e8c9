#include "asperity/texture/compare_textures.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "asperity/base/error.h"
#include "asperity/base/nan.h"
#include "asperity/base/text.h"
#include "asperity/signal/resample.h"
#include "asperity/signal/spectrum.h"
#include "asperity/signal/student.h"
#include "asperity/signal/zero_phase.h"
#include "difference_of_pieces.h"

namespace asperity {
namespace {

void check_spacing(double spacing_m) {
  if (!(spacing_m > 0.0) || !std::isfinite(spacing_m))
    throw Error("compare: the spacing " + number_text(spacing_m) + " m is not a positive length");
}

double band_end(double spacing_m, const CompareTexturesConfig& config) {
  return std::min(config.high_cycles_per_mm, 0.45e-3 / spacing_m);
}

// Welch's densities over cycles/mm of the segments of each line.
struct Spectrum {
  std::vector<double> frequency;
  std::vector<std::vector<std::vector<double>>> density;  // [line][segment][frequency]
  double step = 0.0;

  // [line][segment]: variance in a band.
  PiecesOfLines variance(double low, double high) const {
    PiecesOfLines out(density.size());
    for (std::size_t l = 0; l < density.size(); ++l) {
      for (const auto& segment : density[l]) out[l].push_back(power(segment, low, high));
    }
    return out;
  }

  double mean_frequency(double low, double high) const {
    double sum = 0.0, weight = 0.0;
    for (const auto& line : density) {
      for (const auto& segment : line) {
        for (std::size_t k = 0; k < frequency.size(); ++k) {
          if (frequency[k] < low || frequency[k] > high) continue;
          sum += frequency[k] * segment[k];
          weight += segment[k];
        }
      }
    }
    return weight > 0.0 ? sum / weight : kNan;
  }

 private:
  double power(const std::vector<double>& of, double low, double high) const {
    double sum = 0.0;
    for (std::size_t k = 0; k < frequency.size(); ++k) {
      // The part of the bin that lies in the band, so that bands share no power and lose none.
      const double from = std::max(low, frequency[k] - 0.5 * step);
      const double to = std::min(high, frequency[k] + 0.5 * step);
      if (to > from) sum += of[k] * (to - from);
    }
    return sum;
  }
};

std::size_t shortest_line(const ComparedSurface& surface) {
  std::size_t shortest = surface.lines_m.front().size();
  for (const auto& line : surface.lines_m) shortest = std::min(shortest, line.size());
  return shortest;
}

double shortest_mm(const ComparedSurface& surface) {
  return 1e3 * surface.spacing_m * static_cast<double>(shortest_line(surface));
}

Spectrum spectrum_of(const ComparedSurface& surface, double segment_mm) {
  check_spacing(surface.spacing_m);
  if (surface.lines_m.empty()) throw Error("compare: a surface without a line of heights");
  const double rate = 1e-3 / surface.spacing_m;
  const std::size_t shortest = shortest_line(surface);
  if (shortest < 16) throw Error("compare: a line of " + std::to_string(shortest) + " heights; 16 are needed");
  const auto n =
      static_cast<std::size_t>(std::clamp(std::round(segment_mm * rate), 16.0, static_cast<double>(shortest)));
  Spectrum result;
  for (const auto& line : surface.lines_m) {
    auto& segments = result.density.emplace_back();
    for (std::size_t start = 0; start + n <= line.size(); start += n - n / 2) {
      PowerSpectrum one = welch(std::span(line).subspan(start, n), rate, n);
      result.frequency = std::move(one.frequency);
      segments.push_back(std::move(one.density));
    }
  }
  result.step = result.frequency[1] - result.frequency[0];
  return result;
}

Difference difference(double a, double b) {
  Difference d{a, b, 0.0, kNan, kNan, HandVerdict::kUndetermined};
  if (a != b) d.percent = 100.0 * (b - a) / std::abs(a);
  return d;
}

// What holds within the interval.
void judge(Difference& d, double jnd_percent, double uncertainty_percent) {
  d.jnd_percent = jnd_percent;
  d.uncertainty_percent = uncertainty_percent;
  const double size = std::abs(d.percent);
  if (std::isinf(size) || size - uncertainty_percent > jnd_percent)
    d.verdict = HandVerdict::kNoticeable;
  else if (size + uncertainty_percent <= jnd_percent)
    d.verdict = HandVerdict::kSame;
}

// Hann windows that overlap by half: neighbours' powers correlate by 1/36.
constexpr double kOverlap = 1.0 + 2.0 / 36.0;

// Of RMS values by the variances of segments: half the relative interval, times b/a. Two lines of the same numbers
// differ by nothing; of one segment alone, the power of Gaussian heights in n independent bins is known to √(1/n).
double rms_uncertainty_percent(const Spectrum& a, const Spectrum& b, double low, double high, bool identical) {
  if (identical) return 0.0;
  const PiecesOfLines of_a = a.variance(low, high), of_b = b.variance(low, high);
  const double mean_a = mean_of_pieces(of_a), mean_b = mean_of_pieces(of_b);
  if (!(mean_a > 0.0 && mean_b > 0.0)) return 0.0;
  const double rms_ratio = std::sqrt(mean_b / mean_a);
  const double interval = difference_interval(of_a, of_b, kOverlap);
  if (std::isfinite(interval)) return 50.0 * rms_ratio * interval / mean_b;
  // One segment: Hann's window uses half of it, in which about half of the bins are independent.
  const auto bins = [&](const Spectrum& s) { return std::max(1.0, 0.25 * (high - low) / s.step); };
  const double n_a = bins(a), n_b = bins(b);
  return 50.0 * rms_ratio * student_quantile(0.95, std::min(n_a, n_b)) * std::sqrt(1.0 / n_a + 1.0 / n_b);
}

const PiecesOfLines& pieces_of(const ComparedSurface& surface, const std::string& name) {
  static const PiecesOfLines kNone;
  const auto found = surface.roughness_of_pieces.find(name);
  return found == surface.roughness_of_pieces.end() ? kNone : found->second;
}

// Half of the 95 % interval of b − a, in the quantity's own unit.
double piece_uncertainty(const ComparedSurface& a, const ComparedSurface& b, const std::string& name, bool identical) {
  return identical ? 0.0 : difference_interval(pieces_of(a, name), pieces_of(b, name), 1.0);
}

void add_to_verdict(HandVerdict one, bool& noticeable, bool& undetermined) {
  noticeable = noticeable || one == HandVerdict::kNoticeable;
  undetermined = undetermined || one == HandVerdict::kUndetermined;
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
  const bool identical = a.lines_m == b.lines_m && a.spacing_m == b.spacing_m;
  const double whole_a = mean_of_pieces(spectrum_a.variance(low, high));
  const double whole_b = mean_of_pieces(spectrum_b.variance(low, high));
  const double least = config.least_part * config.least_part;
  const double least_m2 = 1e-12 * config.least_rms_um * config.least_rms_um;
  constexpr double kWaves = 2.0;
  const double shortest = std::min(shortest_mm(a), shortest_mm(b));
  bool noticeable = false, undetermined = false, compared = false;
  for (double from = low; from < high * (1.0 - 1e-9);) {
    // A last band of less than half an octave joins the one before.
    const double to = 2.0 * from * std::sqrt(2.0) > high ? high : 2.0 * from;
    BandDifference band;
    band.low_cycles_per_mm = from;
    band.high_cycles_per_mm = to;
    const double variance_a = mean_of_pieces(spectrum_a.variance(from, to));
    const double variance_b = mean_of_pieces(spectrum_b.variance(from, to));
    band.rms_m = difference(std::sqrt(variance_a), std::sqrt(variance_b));
    judge(band.rms_m, jnd_at(std::sqrt(from * to)),
          rms_uncertainty_percent(spectrum_a, spectrum_b, from, to, identical));
    band.is_compared = variance_a > least * whole_a || variance_b > least * whole_b;
    band.is_felt = variance_a > least_m2 || variance_b > least_m2;
    band.is_resolved = shortest * from >= kWaves * (1.0 - 1e-9);
    compared = compared || band.counts();
    if (band.counts()) add_to_verdict(band.rms_m.verdict, noticeable, undetermined);
    result.bands.push_back(band);
    from = to;
  }
  const bool is_felt = whole_a > least_m2 || whole_b > least_m2;
  const double mean_a = spectrum_a.mean_frequency(low, high);
  result.frequency_per_mm = difference(mean_a, spectrum_b.mean_frequency(low, high));
  for (const auto& [name, value] : a.roughness) {
    const auto found = b.roughness.find(name);
    if (found == b.roughness.end()) continue;
    Difference& d = result.roughness[name] = difference(value, found->second);
    const double interval = piece_uncertainty(a, b, name, identical);
    d.uncertainty_percent = 100.0 * interval / std::abs(value);
    if (name == "Rq_m") d.uncertainty_percent = rms_uncertainty_percent(spectrum_a, spectrum_b, low, high, identical);
    constexpr double kFar = 2.0;
    if (is_felt && (name == "Rsk" || name == "Rku") && std::abs(d.b - d.a) > kFar * interval) result.other_shape = true;
    if (name != "Rq_m" && name != "RSm_m") continue;
    judge(d, jnd_at(mean_a), d.uncertainty_percent);
    if (!is_felt) d.verdict = HandVerdict::kSame;
    add_to_verdict(d.verdict, noticeable, undetermined);
  }
  if (!is_felt)
    result.verdict = HandVerdict::kSame;
  else if (noticeable)
    result.verdict = HandVerdict::kNoticeable;
  else if (compared && !undetermined)
    result.verdict = HandVerdict::kSame;
  return result;
}

}  // namespace asperity
