#include "asperity/profile/pattern_element_width.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "bent_path.h"
#include "profile_features.h"

namespace asperity {

namespace {

constexpr std::size_t kFewestBins = 16, kMostBins = 400;  // of a period
constexpr std::size_t kRepeated = 8;                      // mean periods in a row, so that cut elements hardly count
constexpr double kWhole = 0.1;                            // from a whole number of elements

std::size_t bin_at(std::size_t i, double spacing_m, double pitch_m, std::size_t bins) {
  const double phase = std::fmod(static_cast<double>(i) * spacing_m / pitch_m, 1.0);
  return std::min(bins - 1, static_cast<std::size_t>(phase * static_cast<double>(bins)));
}

// Empty where a part of the period was never measured.
std::vector<double> mean_period(std::span<const double> height_m, double spacing_m, double pitch_m) {
  const auto bins = std::clamp(static_cast<std::size_t>(std::lround(pitch_m / spacing_m)), kFewestBins, kMostBins);
  std::vector<double> sum(bins, 0.0), count(bins, 0.0);
  for (std::size_t i = 0; i < height_m.size(); ++i) {
    if (!std::isfinite(height_m[i])) continue;
    const std::size_t bin = bin_at(i, spacing_m, pitch_m, bins);
    sum[bin] += height_m[i];
    count[bin] += 1.0;
  }
  double mean = 0.0;
  for (std::size_t b = 0; b < bins; ++b) {
    if (count[b] == 0.0) return {};
    sum[b] /= count[b];
    mean += sum[b] / static_cast<double>(bins);
  }
  for (double& h : sum) h -= mean;
  return sum;
}

// Mean square of the heights less their mean and their mean period.
double departure_m2(std::span<const double> height_m, double spacing_m, double pitch_m,
                    const std::vector<double>& period) {
  double sum = 0.0, square = 0.0, count = 0.0;
  for (std::size_t i = 0; i < height_m.size(); ++i) {
    if (!std::isfinite(height_m[i])) continue;
    const double apart_m = height_m[i] - period[bin_at(i, spacing_m, pitch_m, period.size())];
    sum += apart_m;
    square += apart_m * apart_m;
    count += 1.0;
  }
  return count > 0.0 ? square / count - std::pow(sum / count, 2) : 0.0;
}

}  // namespace

namespace {

// Of a pattern whose period is the same all along.
ElementWidth even_element_width(std::span<const double> height_m, double spacing_m, const Periodicity& pattern,
                                const TextureNoise& noise, const RoughnessConfig& config) {
  ElementWidth out;
  if (!pattern.periodic || pattern.periods == 0 || !(pattern.pitch_m > 0.0) || !std::isfinite(pattern.pitch_stderr_m))
    return out;
  if (config.lambda_s_mm > 0.0 || config.lambda_c_mm > 0.0) return out;
  const std::vector<double> period = mean_period(height_m, spacing_m, pattern.pitch_m);
  if (period.empty()) return out;
  const auto [lowest, highest] = std::minmax_element(period.begin(), period.end());
  const double least_m = config.element_height * (*highest - *lowest);
  const auto periods = static_cast<double>(pattern.periods);
  if (!(noise.noise_rms_m / std::sqrt(periods) < least_m)) return out;
  // Roughness that does not repeat splits elements where it is as high as the least one.
  const double noise_m2 = std::pow(noise.noise_rms_m - noise.noise_rms_stderr_m, 2);
  if (!(departure_m2(height_m, spacing_m, pattern.pitch_m, period) - noise_m2 < least_m * least_m)) return out;

  std::vector<double> row;
  for (std::size_t k = 0; k < kRepeated; ++k) row.insert(row.end(), period.begin(), period.end());
  const double step_m = pattern.pitch_m / static_cast<double>(period.size());
  const double least_width_m =
      config.element_width * spacing_m * static_cast<double>(height_m.size()) / static_cast<double>(config.sections);
  double elements = 0.0;
  for (const double times : {0.5, 1.0, 2.0}) {
    const ElementWidths widths = element_widths(row, step_m, times * least_m, least_width_m);
    if (widths.count == 0) return out;
    const double found = pattern.pitch_m * static_cast<double>(widths.count) / widths.sum_m;
    if (std::abs(found - std::round(found)) > kWhole || (elements > 0.0 && std::round(found) != elements)) return out;
    elements = std::round(found);
  }
  out.mean_m = pattern.pitch_m / elements;
  out.stderr_m = std::hypot(pattern.pitch_stderr_m / elements, out.mean_m / periods);
  return out;
}

double missing_share(std::span<const double> height_m) {
  double missing = 0.0;
  for (const double h : height_m) missing += std::isfinite(h) ? 0.0 : 1.0;
  return missing / static_cast<double>(height_m.size());
}

}  // namespace

ElementWidth pattern_element_width(std::span<const double> height_m, double spacing_m, const Periodicity& pattern,
                                   const TextureNoise& noise, const RoughnessConfig& config,
                                   std::span<const Eigen::Vector2d> unrolled_m) {
  if (!std::isfinite(pattern.across_pitch_m)) return even_element_width(height_m, spacing_m, pattern, noise, config);
  if (!std::isfinite(pattern.rib_tangent) || unrolled_m.size() != height_m.size()) return {};
  const BentPath path(unrolled_m, spacing_m);
  if (!path.bends() || !path.crosses(pattern.rib_tangent)) return {};
  Periodicity even = pattern;
  even.pitch_stderr_m = pattern.pitch_m * pattern.across_pitch_stderr_m / pattern.across_pitch_m;
  ElementWidth out =
      even_element_width(path.straightened(height_m, pattern.rib_tangent), spacing_m, even, noise, config);
  const double uneven = path.spread_of_period(pattern.rib_tangent) * missing_share(height_m);
  out.stderr_m = std::hypot(out.stderr_m, uneven * out.mean_m);
  return out;
}

ElementWidth pattern_element_width(std::span<const double> height_m, double spacing_m, const Periodicity& pattern,
                                   const TextureNoise& noise, const RoughnessConfig& config) {
  return pattern_element_width(height_m, spacing_m, pattern, noise, config, {});
}

}  // namespace asperity
