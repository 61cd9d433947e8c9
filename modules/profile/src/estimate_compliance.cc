#include "asperity/profile/estimate_compliance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "asperity/base/error.h"
#include "asperity/signal/statistics.h"
#include "compliance_windows.h"
#include "fit_force_law.h"

namespace asperity {
namespace {

// From a law near a power of the force to one that outruns an elastic contact's, whose radius squared goes with F.
constexpr std::array<double, 5> kForcePowers = {0.25, 0.5, 0.75, 1.0, 1.25};
constexpr double kLeastSpan = 2.0;  // below it nothing is determined
constexpr double kMostLost = 0.5;
constexpr double kNormal95 = 1.959963984540054;

// ∂ ln(amplitude) and k_c, its mean and variance over the laws.
struct Average {
  double weight = 0.0, softness = 0.0, softness2 = 0.0, k_c = 0.0, k_c2 = 0.0;

  void add(double w, double g, double g_sigma, double k, double k_sigma) {
    weight += w;
    softness += w * g;
    softness2 += w * (g * g + g_sigma * g_sigma);
    k_c += w * k;
    k_c2 += w * (k * k + k_sigma * k_sigma);
  }
};

double coefficient(double softness, double force_power) {
  return compliance_coefficient(standard_sigma_r2(softness, force_power));
}

void estimate_coefficient(const ComplianceWindows& windows, const ComplianceConfig& config, Compliance& out) {
  const ForcePowers data{windows.force_N, windows.power, windows.noise};
  std::array<ForceLaw, kForcePowers.size()> laws;
  for (std::size_t i = 0; i < laws.size(); ++i) laws[i] = fit_force_law(data, kForcePowers[i]);
  const ForceLaw& best = *std::min_element(
      laws.begin(), laws.end(), [](const ForceLaw& a, const ForceLaw& b) { return a.deviance < b.deviance; });
  Average average;
  for (std::size_t i = 0; i < laws.size(); ++i) {
    const double g = laws[i].softness, p = kForcePowers[i];
    const double sigma = std::hypot(laws[i].softness_stderr, config.softness_sigma);
    const double weight = std::exp((best.deviance - laws[i].deviance) / std::max(best.dispersion, 1e-6));
    // Bounded: a law that is not determined must not give an infinite difference.
    const double reach = std::min(sigma, 1.0);
    const double slope = (coefficient(g - reach, p) - coefficient(g + reach, p)) / (2.0 * reach);
    average.add(weight, g, sigma, coefficient(g, p), slope * std::min(sigma, 10.0));
  }
  const double mean_g = average.softness / average.weight, mean_k = average.k_c / average.weight;
  out.exponent = 1.0 + mean_g;
  out.exponent_error = std::sqrt(std::max(0.0, average.softness2 / average.weight - mean_g * mean_g));
  out.k_c_stderr = std::sqrt(std::max(0.0, average.k_c2 / average.weight - mean_k * mean_k));
  out.k_c = std::min(1.0, mean_k);
  out.k_c_low = std::clamp(mean_k - kNormal95 * out.k_c_stderr, 0.0, 1.0);
  out.k_c_high = std::clamp(mean_k + kNormal95 * out.k_c_stderr, 0.0, 1.0);
  out.sigma_r2 = -std::log(out.k_c);
}

std::string missing_windows(const ComplianceWindows& windows, const ComplianceConfig& config) {
  if (static_cast<double>(windows.lost) > kMostLost * static_cast<double>(windows.moving)) {
    return fmt::format(
        "not determined: in {:.0f} % of the sections of {:g} mm the force falls below a quarter of its mean, as where "
        "the tip leaves the surface; press harder or move slower",
        100.0 * static_cast<double>(windows.lost) / static_cast<double>(windows.moving), config.window_mm);
  }
  return fmt::format("not determined: the strokes have {} sections of {:g} mm with force, {} are needed",
                     windows.force_N.size(), config.window_mm, config.min_windows);
}

}  // namespace

double compliance_coefficient(double sigma_r2) { return std::exp(-sigma_r2); }

double standard_sigma_r2(double softness, double force_power) {
  constexpr int kPoints = 64;
  const double g = std::max(-1.0, softness);
  double sum = 0.0, squares = 0.0, force = 0.0, force2 = 0.0;
  for (int i = 0; i < kPoints; ++i) {
    const double f = kStandardLightest_N + (kStandardFirmest_N - kStandardLightest_N) * (i + 0.5) / kPoints;
    const double r = f * std::exp(g * (std::pow(f, force_power) - 1.0) / force_power);
    sum += r;
    squares += r * r;
    force += f;
    force2 += f * f;
  }
  return kPoints * (squares / (sum * sum) - force2 / (force * force));
}

Compliance estimate_compliance(const TipMotion& samples, std::span<const std::int64_t> normal_t_ns,
                               std::span<const Eigen::Vector3d> n_world, const ComplianceConfig& config) {
  const std::size_t n = samples.size();
  if (samples.a_world_tip_mps2.size() != n || samples.p_world_tip_m.size() != n || samples.force_N.size() != n ||
      normal_t_ns.size() != n_world.size() || n_world.empty()) {
    throw Error("compliance: " + std::to_string(n) + " samples, " + std::to_string(samples.a_world_tip_mps2.size()) +
                " accelerations, " + std::to_string(samples.force_N.size()) + " forces, " +
                std::to_string(n_world.size()) + " normals");
  }
  Compliance out;
  if (std::none_of(samples.force_N.begin(), samples.force_N.end(), [](double f) { return std::isfinite(f); })) {
    out.verdict = "not determined: no force was measured";
    return out;
  }
  const ComplianceWindows windows = cut_compliance_windows(samples, normal_t_ns, n_world, config);
  out.rest_amplitude_mps2 = windows.rest_amplitude_mps2;
  if (windows.moving > 0) out.lost_fraction = static_cast<double>(windows.lost) / static_cast<double>(windows.moving);
  if (windows.force_N.empty()) {
    out.verdict = missing_windows(windows, config);
    return out;
  }
  std::vector<double> ratio;
  for (std::size_t j = 0; j < windows.force_N.size(); ++j) {
    const double v = windows.speed_mps[j];
    const double curvature =
        std::sqrt(std::max(windows.power[j] - windows.noise[j], 0.05 * windows.power[j]) / (1e-3 * config.window_mm));
    out.windows.push_back({windows.force_N[j], v * v * curvature, v, 0.0});
    ratio.push_back(curvature > 0.0 ? windows.force_N[j] / curvature : 0.0);
  }
  const double mean_ratio = mean(ratio);
  for (std::size_t j = 0; j < ratio.size(); ++j) out.windows[j].ratio = ratio[j] /= mean_ratio;
  if (ratio.size() > 1) out.ratio_variance = variance(ratio);
  const auto [light, firm] = std::minmax_element(windows.force_N.begin(), windows.force_N.end());
  out.lightest_N = *light;
  out.firmest_N = *firm;
  if (out.windows.size() < static_cast<std::size_t>(config.min_windows)) {
    out.verdict = missing_windows(windows, config);
    return out;
  }
  // On a soft surface the texture may stand out where the force is light only.
  if (!(percentile(windows.power, 90.0) > 3.0 * mean(windows.noise))) {
    out.verdict = fmt::format(
        "not determined: no waves of {:.2g} to {:.2g} mm are above the noise of the stationary probe; move faster, or "
        "on a rougher area",
        1.0 / config.max_cycles_per_mm, 1.0 / config.min_cycles_per_mm);
    return out;
  }
  const double span = *firm / *light;
  estimate_coefficient(windows, config, out);
  out.determined =
      span >= config.min_force_ratio || (span >= kLeastSpan && out.k_c_stderr <= config.max_stderr * out.k_c);
  if (out.determined) {
    out.verdict = "determined";
  } else {
    out.verdict = fmt::format(
        "not determined: the force went from {:.2g} to {:.2g} N: press {:g} times as hard at the end of a stroke as at "
        "its "
        "beginning",
        *light, *firm, config.min_force_ratio);
    out.k_c = out.k_c_low = out.k_c_high = out.sigma_r2 = std::numeric_limits<double>::quiet_NaN();
  }
  return out;
}

}  // namespace asperity
