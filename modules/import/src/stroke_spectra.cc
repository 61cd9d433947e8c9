#include "asperity/import/stroke_spectra.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <span>
#include <utility>

#include "asperity/import/stroke_windows.h"
#include "asperity/signal/spectrum.h"

namespace asperity {

namespace {

constexpr double kWindow_s = 0.25, kSteady = 0.2;
constexpr double kLowest = 2.0, kHighest = 0.4;  // of the high-pass and of the rate
constexpr double kBinsPerOctave = 12.0;
constexpr int kFirstOctave = -4, kOctaves = 12;  // from 2^-4 cycles/mm

PowerSpectrum window_spectrum(const Stroke& stroke, std::size_t first, std::size_t length) {
  return welch(std::span(stroke.acceleration_mps2).subspan(first, length), stroke.rate_Hz, length);
}

std::vector<double> mean_density(const Stroke& stroke, const std::vector<std::size_t>& firsts, std::size_t length) {
  std::vector<double> out;
  for (const std::size_t first : firsts) {
    const PowerSpectrum s = window_spectrum(stroke, first, length);
    out.resize(s.density.size(), 0.0);
    for (std::size_t k = 0; k < s.density.size(); ++k) out[k] += s.density[k] / static_cast<double>(firsts.size());
  }
  return out;
}

// The mean speed of a window, m/s; 0 if it changes by a fifth or more.
double steady_speed(const Stroke& stroke, std::size_t first, std::size_t length) {
  const auto speed = std::span(stroke.speed_mps).subspan(first, length);
  const auto [low, high] = std::minmax_element(speed.begin(), speed.end());
  double mean = 0.0;
  for (const double v : speed) mean += v / static_cast<double>(length);
  return *high - *low < kSteady * mean ? mean : 0.0;
}

struct Octave {
  std::vector<double> power, noise;  // m², a window each
};

// The part of a line's bin within [low, high].
double share(double frequency, double step, double low, double high) {
  return std::max(0.0, std::min(high, frequency + 0.5 * step) - std::max(low, frequency - 0.5 * step));
}

StrokeHeightBand band_of(int octave, const Octave& found) {
  StrokeHeightBand out;
  out.low_cycles_per_mm = std::exp2(octave);
  out.high_cycles_per_mm = std::exp2(octave + 1);
  out.windows = found.power.size();
  const auto n = static_cast<double>(out.windows);
  double mean = 0.0, noise = 0.0, squares = 0.0;
  for (const double p : found.power) mean += p / n;
  for (const double p : found.noise) noise += p / n;
  for (const double p : found.power) squares += (p - mean) * (p - mean);
  out.rms_m = std::sqrt(std::max(0.0, mean));
  out.noise_rms_m = std::sqrt(noise);
  out.rms_sigma_m = std::numeric_limits<double>::quiet_NaN();
  // Of a power that noise hides, the height that its error alone would be.
  if (n > 1.0) {
    const double sigma = std::sqrt(squares / (n * (n - 1.0)));
    out.rms_sigma_m = mean > sigma ? sigma / (2.0 * out.rms_m) : std::sqrt(sigma);
  }
  return out;
}

}  // namespace

VibrationSpectrum vibration_spectrum(const Stroke& stroke) {
  VibrationSpectrum out;
  const StrokeWindows windows = find_stroke_windows(stroke, stroke.acceleration_mps2, kWindow_s);
  if (windows.active.empty()) return out;
  out.frequency_Hz = window_spectrum(stroke, windows.active.front(), windows.length).frequency;
  out.density = mean_density(stroke, windows.active, windows.length);
  out.noise = mean_density(stroke, windows.quiet, windows.length);
  return out;
}

StrokeHeightSpectrum stroke_height_spectrum(const Stroke& stroke) {
  StrokeHeightSpectrum out;
  if (stroke.speed_mps.empty()) return out;
  const StrokeWindows windows = find_stroke_windows(stroke, stroke.acceleration_mps2, kWindow_s);
  const std::vector<double> quiet = mean_density(stroke, windows.quiet, windows.length);
  out.noise_is_known = !quiet.empty();
  struct Bin {
    double frequency = 0.0, density = 0.0, noise = 0.0, count = 0.0;
  };
  std::map<int, Bin> bins;
  std::map<int, Octave> octaves;
  const double low_Hz = kLowest * stroke.high_pass_Hz, high_Hz = kHighest * stroke.rate_Hz;
  for (const std::size_t first : windows.active) {
    const double speed_mm = 1e3 * steady_speed(stroke, first, windows.length);
    if (!(speed_mm > 0.0)) continue;
    ++out.windows;
    const PowerSpectrum s = window_spectrum(stroke, first, windows.length);
    const double step_Hz = s.frequency[1] - s.frequency[0];
    std::vector<double> height(s.frequency.size(), 0.0), noise(s.frequency.size(), 0.0);  // m²/Hz
    for (std::size_t k = 1; k < s.frequency.size(); ++k) {
      const double per = std::pow(2.0 * std::numbers::pi * s.frequency[k], -4);
      noise[k] = quiet.empty() ? 0.0 : quiet[k] * per;
      height[k] = s.density[k] * per - noise[k];
      if (s.frequency[k] < low_Hz || s.frequency[k] > high_Hz) continue;
      const double cycles_per_mm = s.frequency[k] / speed_mm;
      Bin& bin = bins[static_cast<int>(std::floor(kBinsPerOctave * std::log2(cycles_per_mm)))];
      bin.frequency += cycles_per_mm;
      bin.density += height[k] * speed_mm;
      bin.noise += noise[k] * speed_mm;
      bin.count += 1.0;
    }
    for (int octave = kFirstOctave; octave < kFirstOctave + kOctaves; ++octave) {
      const double from_Hz = std::exp2(octave) * speed_mm, to_Hz = 2.0 * from_Hz;
      if (from_Hz < low_Hz || to_Hz > high_Hz) continue;
      double power = 0.0, of_noise = 0.0;
      for (std::size_t k = 1; k < s.frequency.size(); ++k) {
        const double width = share(s.frequency[k], step_Hz, from_Hz, to_Hz);
        power += height[k] * width;
        of_noise += noise[k] * width;
      }
      octaves[octave].power.push_back(power);
      octaves[octave].noise.push_back(of_noise);
    }
  }
  for (const auto& [place, bin] : bins) {
    out.cycles_per_mm.push_back(bin.frequency / bin.count);
    out.density_m2_mm.push_back(std::max(0.0, bin.density / bin.count));
    out.noise_m2_mm.push_back(bin.noise / bin.count);
  }
  for (const auto& [octave, found] : octaves) out.octaves.push_back(band_of(octave, found));
  return out;
}

}  // namespace asperity
