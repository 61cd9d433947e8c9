#include "asperity/texture/fit_stochastic.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/base/plausible_profile.h"
#include "asperity/base/text.h"
#include "asperity/signal/spectrum.h"
#include "asperity/texture/evaluate_stochastic.h"
#include "window.h"

namespace asperity {
namespace {

constexpr std::size_t kFewestSamples = 64;
constexpr std::size_t kSynthesised = 1 << 16;

double normal_cdf(double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }

// Moments about the mean, and the distribution function's distance.
void measure_distribution(std::vector<double> z, StochasticFit& fit) {
  std::sort(z.begin(), z.end());
  if (z.front() == z.back()) throw Error("texture: all heights are equal, so that a texture cannot be fitted");
  const double n = static_cast<double>(z.size());
  double mean = 0.0;
  for (const double v : z) mean += v / n;
  double m2 = 0.0;
  double m3 = 0.0;
  double m4 = 0.0;
  for (const double v : z) {
    const double d = v - mean;
    m2 += d * d / n;
    m3 += d * d * d / n;
    m4 += d * d * d * d / n;
  }
  fit.texture.sigma_m = std::sqrt(m2);
  fit.skewness = m3 / (m2 * std::sqrt(m2));
  fit.excess_kurtosis = m4 / (m2 * m2) - 3.0;
  for (std::size_t i = 0; i < z.size(); ++i) {
    const double f = normal_cdf((z[i] - mean) / fit.texture.sigma_m);
    const double below = static_cast<double>(i) / n;
    const double above = static_cast<double>(i + 1) / n;
    fit.kolmogorov_distance = std::max({fit.kolmogorov_distance, f - below, above - f});
  }
}

double correlation_length_m(std::span<const double> z, double spacing_m) {
  double mean = 0.0;
  for (const double v : z) mean += v / static_cast<double>(z.size());
  double first = 0.0;
  double last = 1.0;
  for (std::size_t lag = 0; lag < z.size(); ++lag) {
    double sum = 0.0;
    for (std::size_t i = lag; i < z.size(); ++i) sum += (z[i] - mean) * (z[i - lag] - mean);
    if (lag == 0) {
      if (!(sum > 0.0)) return spacing_m;
      first = sum;
      continue;
    }
    const double r = sum / first;
    const double wanted = 1.0 / std::numbers::e;
    if (r < wanted) return spacing_m * (static_cast<double>(lag) - (wanted - r) / (last - r));
    last = r;
  }
  return spacing_m * static_cast<double>(z.size());
}

double misplaced(const std::vector<double>& p, const std::vector<double>& q) {
  double p_sum = 0.0;
  double q_sum = 0.0;
  // The mean is removed before: the lowest bin says nothing.
  for (std::size_t i = 1; i < p.size(); ++i) {
    p_sum += p[i];
    q_sum += q[i];
  }
  double sum = 0.0;
  for (std::size_t i = 1; i < p.size(); ++i) sum += 0.5 * std::abs(p[i] / p_sum - q[i] / q_sum);
  return sum;
}

}  // namespace

StochasticFit fit_stochastic(std::span<const double> height_m, double spacing_m, const FitStochasticConfig& config) {
  require_plausible_spacing(spacing_m, "texture");
  require_plausible_heights(height_m, "texture");
  std::vector<double> present;
  for (const double h : height_m) {
    if (!std::isnan(h)) present.push_back(h);
  }
  const Window window = longest_stretch(bridge_short_gaps(height_m, 0));
  if (window.count < kFewestSamples) {
    throw Error("texture: the longest gap-free stretch has " + std::to_string(window.count) + " heights; at least " +
                std::to_string(kFewestSamples) + " are needed");
  }
  const auto stretch = height_m.subspan(window.first, window.count);

  StochasticFit fit;
  fit.samples = present.size();
  measure_distribution(std::move(present), fit);
  fit.correlation_length_m = correlation_length_m(stretch, spacing_m);
  fit.texture.tangential_ratio = config.tangential_ratio;
  fit.texture.offset_sigmas = config.offset_sigmas;
  fit.texture.stiffness_N_per_m = config.stiffness_N_per_m;
  if (config.use_correlation_length) fit.texture.correlation_length_m = fit.correlation_length_m;

  const std::size_t segment = std::clamp<std::size_t>(window.count / 8, 16, 1024);
  const auto source = welch(stretch, 1.0 / spacing_m, segment);
  fit.not_white = misplaced(source.density, std::vector<double>(source.density.size(), 1.0));
  // Stroked at one spacing a step, the series is the profile that the texture would make.
  StochasticTexture plain = fit.texture;
  plain.offset_sigmas = 0.0;
  plain.fade_speed_mps = 0.0;
  SeriesState state = start_series(1);
  std::vector<double> synthesised(kSynthesised);
  for (double& z : synthesised) z = next_height_m(plain, state, spacing_m, 1.0, 1.0);
  fit.misplaced_power = misplaced(source.density, welch(synthesised, 1.0 / spacing_m, segment).density);
  if (fit.misplaced_power > 0.5) {
    fit.problems.push_back(
        {"not_stochastic",
         number_text(std::round(100.0 * fit.misplaced_power)) +
             " % of the profile's power is where a stochastic texture has none: the profile has a pattern",
         1});
  }
  return fit;
}

}  // namespace asperity
