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

std::vector<std::vector<double>> densities(const Stroke& stroke, const std::vector<std::size_t>& firsts,
                                           std::size_t length) {
  std::vector<std::vector<double>> out;
  for (const std::size_t first : firsts) out.push_back(window_spectrum(stroke, first, length).density);
  return out;
}

std::vector<double> mean_of(const std::vector<std::vector<double>>& densities) {
  std::vector<double> out;
  for (const std::vector<double>& one : densities) {
    out.resize(one.size(), 0.0);
    for (std::size_t k = 0; k < one.size(); ++k) out[k] += one[k] / static_cast<double>(densities.size());
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
  std::vector<double> weight;        // of the quiet's density in the mean of `noise`, a line each
};

// The part of a line's bin within [low, high].
double share(double frequency, double step, double low, double high) {
  return std::max(0.0, std::min(high, frequency + 0.5 * step) - std::max(low, frequency - 0.5 * step));
}

// The variance of the noise's mean power, which every window has in common: by the scatter of the quiet windows, and by
// that of Gaussian noise, whose periodograms with a Hann window have the correlations 4/9 and 1/36 between lines one
// and two apart. The larger: a few windows scatter too little as often as too much.
double noise_variance(const std::vector<double>& weight, const std::vector<std::vector<double>>& quiet) {
  const auto m = static_cast<double>(quiet.size());
  if (quiet.empty()) return 0.0;
  const std::vector<double> mean = mean_of(quiet);
  // Squares and products of an estimate of m windows are too large by as much as they scatter, 1/m of it.
  constexpr double kNext = 4.0 / 9.0, kNextButOne = 1.0 / 36.0;
  double gaussian = 0.0;
  for (std::size_t k = 0; k < mean.size(); ++k) {
    const double at = weight[k] * mean[k];
    gaussian += at * at / (1.0 + 1.0 / m);
    if (k + 1 < mean.size()) gaussian += 2.0 * kNext * at * weight[k + 1] * mean[k + 1] / (1.0 + kNext / m);
    if (k + 2 < mean.size()) gaussian += 2.0 * kNextButOne * at * weight[k + 2] * mean[k + 2] / (1.0 + kNextButOne / m);
  }
  gaussian /= m;
  if (quiet.size() < 2) return gaussian;
  std::vector<double> powers;
  double all = 0.0, squares = 0.0;
  for (const std::vector<double>& one : quiet) {
    double power = 0.0;
    for (std::size_t k = 0; k < one.size(); ++k) power += weight[k] * one[k];
    powers.push_back(power);
    all += power / m;
  }
  for (const double power : powers) squares += (power - all) * (power - all);
  return std::max(gaussian, squares / (m * (m - 1.0)));
}

StrokeHeightBand band_of(int octave, const Octave& found, const std::vector<std::vector<double>>& quiet) {
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
    std::vector<double> weight = found.weight;
    for (double& w : weight) w /= n;
    const double sigma = std::sqrt(squares / (n * (n - 1.0)) + noise_variance(weight, quiet));
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
  out.density = mean_of(densities(stroke, windows.active, windows.length));
  out.noise = mean_of(densities(stroke, windows.quiet, windows.length));
  return out;
}

StrokeHeightSpectrum stroke_height_spectrum(const Stroke& stroke) {
  StrokeHeightSpectrum out;
  if (stroke.speed_mps.empty()) return out;
  const StrokeWindows windows = find_stroke_windows(stroke, stroke.acceleration_mps2, kWindow_s);
  const std::vector<std::vector<double>> quiet_windows = densities(stroke, windows.quiet, windows.length);
  const std::vector<double> quiet = mean_of(quiet_windows);
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
      Octave& found = octaves[octave];
      found.weight.resize(s.frequency.size(), 0.0);
      double power = 0.0, of_noise = 0.0;
      for (std::size_t k = 1; k < s.frequency.size(); ++k) {
        const double width = share(s.frequency[k], step_Hz, from_Hz, to_Hz);
        power += height[k] * width;
        of_noise += noise[k] * width;
        found.weight[k] += width * std::pow(2.0 * std::numbers::pi * s.frequency[k], -4);
      }
      found.power.push_back(power);
      found.noise.push_back(of_noise);
    }
  }
  for (const auto& [place, bin] : bins) {
    out.cycles_per_mm.push_back(bin.frequency / bin.count);
    out.density_m2_mm.push_back(std::max(0.0, bin.density / bin.count));
    out.noise_m2_mm.push_back(bin.noise / bin.count);
  }
  for (const auto& [octave, found] : octaves) out.octaves.push_back(band_of(octave, found, quiet_windows));
  return out;
}

}  // namespace asperity
