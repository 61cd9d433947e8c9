#include "learn_noise.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <vector>

namespace asperity::inertial_smoother {

namespace {

// What the calibration and the settings state is worth this many observations.
constexpr double kPrior = 10.0;
constexpr double kSlowPrior = 2.0;  // that nobody measured

struct Bounds {
  double lowest, highest;
};

// The sensors' own noise is a floor: a smaller factor would only fit the recording's luck.
Bounds bounds_of(Component component, bool has_gyro) {
  switch (component) {
    case kAccelOwn:
    case kGyroOwn:
      return {0.3, 1e5};
    case kRateWalk:
      return has_gyro ? Bounds{0.01, 1e5} : Bounds{1e-4, 1e6};
    case kAccelMatrix:
    case kGyroMatrix:
    case kGravity:
      return {0.1, 100.0};
    case kPositionX:
    case kPositionY:
    case kPositionZ:
    case kRotationX:
    case kRotationY:
    case kRotationZ:
      return {0.04, 1e3};
    default:
      return {1e-4, 1e5};
  }
}

bool is_tracker(Component component) { return component >= kPositionX && component <= kSlowTurn; }

}  // namespace

Factors first_factors(bool has_gyro, const FusedConfig& config) {
  Factors out = kUnitFactors;
  if (config.process_noise_scale > 0.0) return out;
  out[kAccelOwn] = out[kGyroOwn] = out[kAccelFast] = 4.0;
  out[kAccelMotion] = out[kGyroMotion] = 25.0;
  if (!has_gyro) out[kRateWalk] = 10.0;
  return out;
}

namespace {

// How much larger the residuals' middle is than that of three degrees of freedom; 1 where it is hardly.
double excess(std::vector<double> chi2, const Problem& problem) {
  constexpr double kMedian = 2.366;
  constexpr double kHardly = 1.5;
  std::vector<double> values;
  for (const Epoch& epoch : problem.epochs) {
    if (epoch.pose >= 0) values.push_back(chi2[static_cast<std::size_t>(epoch.pose)]);
  }
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  const double ratio = *middle / kMedian;
  return ratio > kHardly ? ratio : 1.0;
}

}  // namespace

void widen_tracker(const Problem& problem, const FusedConfig& config, Smoothed& smoothed, Factors& factors) {
  if (!config.adapt_tracker_noise) return;
  const auto widen = [&](std::vector<double>& chi2, std::initializer_list<Component> components) {
    const double ratio = excess(chi2, problem);
    if (ratio == 1.0) return;
    for (double& value : chi2) value /= ratio;
    for (const Component component : components) {
      const Bounds bounds = bounds_of(component, true);
      factors[component] = std::clamp(factors[component] * ratio, bounds.lowest, bounds.highest);
    }
  };
  widen(smoothed.position_chi2, {kPositionX, kPositionY, kPositionZ});
  widen(smoothed.rotation_chi2, {kRotationX, kRotationY, kRotationZ});
}

void improve_factors(const NoiseScore& score, const FusedConfig& config, bool has_gyro, Factors& factors) {
  for (std::size_t i = 0; i < kComponents; ++i) {
    const auto component = static_cast<Component>(i);
    if (is_tracker(component) ? !config.adapt_tracker_noise : config.process_noise_scale > 0.0) continue;
    const Bounds bounds = bounds_of(component, has_gyro);
    const double prior = component == kSlow || component == kSlowTurn ? kSlowPrior : kPrior;
    const double ratio = (score.seen[i] + prior / factors[i]) / (score.expected[i] + prior);
    factors[i] = std::clamp(factors[i] * std::clamp(ratio, 0.05, 20.0), bounds.lowest, bounds.highest);
  }
}

}  // namespace asperity::inertial_smoother
