#include "asperity/texture/fit_fourier1d.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/base/plausible_profile.h"
#include "asperity/base/rounded_text.h"
#include "asperity/base/text.h"
#include "asperity/texture/evaluate_fourier1d.h"
#include "window.h"

namespace asperity {
namespace {

void check_heights(std::span<const double> height_m, double spacing_m, const FitFourier1dConfig& config) {
  require_plausible_spacing(spacing_m, "texture");
  if (!(config.length_mm > 0.0) || !std::isfinite(config.length_mm)) {
    throw Error("texture: the length " + number_text(config.length_mm) + " mm is not positive");
  }
  if (config.coefficients < 1)
    throw Error("texture: " + std::to_string(config.coefficients) + " coefficients; at least one is needed");
  require_plausible_heights(height_m, "texture");
}

// The number of samples nearest to a length, at most a billion; 0 for a length that is not positive.
std::size_t samples_of(double length_mm, double spacing_m) {
  const double samples = std::round(length_mm * 1e-3 / spacing_m);
  return samples > 0.0 ? static_cast<std::size_t>(std::min(samples, 1e9)) : 0;
}

Window choose_window(const BridgedProfile& profile, double spacing_m, const FitFourier1dConfig& config,
                     Problems& problems) {
  const std::size_t count = samples_of(config.length_mm, spacing_m);
  if (count <= 2 * static_cast<std::size_t>(config.coefficients)) {
    throw Error("texture: " + std::to_string(config.coefficients) + " coefficients need more than " +
                std::to_string(2 * config.coefficients) + " samples; a length of " + number_text(config.length_mm) +
                " mm has " + std::to_string(count));
  }
  const Window window = best_window(profile, count, samples_of(config.seam_mm, spacing_m));
  if (window.found()) return window;
  const Window longest = longest_stretch(profile);
  const double longest_mm = static_cast<double>(longest.count) * spacing_m * 1e3;
  if (longest.count < 3 || longest_mm < config.shortest_mm) {
    throw Error("texture: the longest gap-free stretch is " + rounded_text(longest_mm) + " mm; at least " +
                rounded_text(std::min(config.shortest_mm, config.length_mm)) + " mm is needed");
  }
  problems.push_back({"short_texture",
                      "no gap-free stretch of " + rounded_text(config.length_mm) + " mm: the texture is " +
                          rounded_text(longest_mm) + " mm long",
                      1});
  return longest;
}

Fourier1d transform_heights(const std::vector<double>& z, std::size_t coefficients, double length_mm,
                            const Observer& observer) {
  const std::size_t count = z.size();
  std::vector<double> cosine(count), sine(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(count);
    cosine[i] = std::cos(angle);
    sine[i] = std::sin(angle);
  }
  Fourier1d texture{length_mm, std::vector<double>(coefficients), std::vector<double>(coefficients), 0.0};
  const double scale = 2.0 / static_cast<double>(count);
  for (const double v : z) texture.mean_m += v / static_cast<double>(count);
  for (std::size_t j = 1; j <= coefficients; ++j) {
    observer.update("texture", static_cast<double>(j) / static_cast<double>(2 * coefficients));
    double real = 0.0;
    double minus_imaginary = 0.0;
    std::size_t phase = 0;
    for (std::size_t i = 0; i < count; ++i) {
      real += z[i] * cosine[phase];
      minus_imaginary += z[i] * sine[phase];
      phase += j;
      if (phase >= count) phase -= count;
    }
    texture.a_m[j - 1] = scale * real;
    texture.b_m[j - 1] = scale * minus_imaginary;
  }
  return texture;
}

}  // namespace

FourierFit fit_fourier1d(std::span<const double> height_m, double spacing_m, const FitFourier1dConfig& config,
                         const Observer& observer) {
  check_heights(height_m, spacing_m, config);
  FourierFit fit;
  const BridgedProfile profile = bridge_short_gaps(height_m, samples_of(config.max_gap_mm, spacing_m));
  const Window window = choose_window(profile, spacing_m, config, fit.problems);
  const auto periodic_m = close_seam(profile, window, samples_of(config.seam_mm, spacing_m));

  double length_mm = static_cast<double>(window.count) * spacing_m * 1e3;
  if (std::abs(length_mm - config.length_mm) < 1e-9 * config.length_mm) length_mm = config.length_mm;
  const std::size_t coefficients = std::min(static_cast<std::size_t>(config.coefficients), (window.count - 1) / 2);
  fit.texture = transform_heights(periodic_m, coefficients, length_mm, observer);
  fit.first_sample = window.first;
  fit.samples = window.count;
  fit.bridged = profile.bridged_before[window.first + window.count] - profile.bridged_before[window.first];
  fit.height_offset_m = height_offset_m(fit.texture);

  double mean_m = 0.0;
  for (std::size_t i = 0; i < window.count; ++i)
    mean_m += profile.height_m[window.first + i] / static_cast<double>(window.count);
  double square = 0.0;
  double error = 0.0;
  constexpr std::size_t kBlock = 64;  // a height costs as many products as there are coefficients
  for (std::size_t i = 0; i < window.count; ++i) {
    if (i % kBlock == 0)
      observer.update("texture", 0.5 + 0.5 * static_cast<double>(i) / static_cast<double>(window.count));
    const double z = profile.height_m[window.first + i];
    const double x_m = length_mm * 1e-3 * static_cast<double>(i) / static_cast<double>(window.count);
    const double difference = evaluate_height(fit.texture, x_m).height_m - z;
    square += (z - mean_m) * (z - mean_m);
    error += difference * difference;
  }
  fit.rms_height_m = std::sqrt(square / static_cast<double>(window.count));
  fit.rms_error_m = std::sqrt(error / static_cast<double>(window.count));
  return fit;
}

}  // namespace asperity
