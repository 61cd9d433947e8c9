#include "asperity/profile/bound_tip_radius.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "asperity/signal/chi_square.h"
#include "spectrum_at.h"

namespace asperity {

namespace {

constexpr std::array<double, 9> kSmoothings_m{25e-6, 35e-6, 50e-6, 71e-6, 100e-6, 141e-6, 200e-6, 283e-6, 400e-6};
constexpr double kReach_sigmas = 4.0;
constexpr double kDoubt = 0.025;
constexpr double kSureOfNoise = 1.96;

// A Gaussian and its first two derivatives at the points' distances, as weights of heights.
struct Kernel {
  std::vector<double> slope, bend;
  std::ptrdiff_t reach = 0;

  Kernel(double sigma_m, double spacing_m)
      : reach(static_cast<std::ptrdiff_t>(std::ceil(kReach_sigmas * sigma_m / spacing_m))) {
    std::vector<double> weight;
    double sum = 0.0;
    // One point wider on both sides: the derivatives are differences of the weights, so that they are those of a mean
    // with positive weights to the last digit.
    for (std::ptrdiff_t i = -reach - 1; i <= reach + 1; ++i) {
      const double u = static_cast<double>(i) * spacing_m / sigma_m;
      weight.push_back(std::abs(i) <= reach - 1 ? std::exp(-0.5 * u * u) : 0.0);
      sum += weight.back();
    }
    for (std::size_t i = 1; i + 1 < weight.size(); ++i) {
      slope.push_back((weight[i - 1] - weight[i + 1]) / (2.0 * spacing_m * sum));
      bend.push_back((weight[i - 1] - 2.0 * weight[i] + weight[i + 1]) / (spacing_m * spacing_m * sum));
    }
  }

  // What the weights leave of a wave, squared: of the second derivative, 1/m².
  double bend_gain2(double cycles_per_m, double spacing_m) const {
    double re = 0.0;
    for (std::ptrdiff_t i = -reach; i <= reach; ++i) {
      re += bend[static_cast<std::size_t>(i + reach)] *
            std::cos(2.0 * std::numbers::pi * cycles_per_m * spacing_m * static_cast<double>(i));
    }
    return re * re;
  }
};

// Standard deviation of (g ∗ h)″ by the density of the noise, 1/m.
double bend_sigma_per_m(const Kernel& kernel, const TextureNoise& noise, double spacing_m) {
  const double highest = 0.5e-3 / spacing_m, step = highest / 400.0;
  double sum = 0.0;
  for (double f = 0.5 * step; f < highest; f += step) {
    sum += step * kernel.bend_gain2(1e3 * f, spacing_m) *
           spectrum_at(noise.frequency_cycles_per_mm, noise.added_psd_m2_mm, f);
  }
  return std::sqrt(sum);
}

double mean_of_known(std::span<const double> sigma_m) {
  double sum = 0.0, count = 0.0;
  for (const double one : sigma_m) {
    if (!(one > 0.0)) continue;
    sum += one * one;
    count += 1.0;
  }
  return count > 0.0 ? std::sqrt(sum / count) : 0.0;
}

}  // namespace

TipRadiusBound bound_tip_radius(const Profile& profile, const TextureNoise& noise) {
  TipRadiusBound out;
  if (noise.added_psd_m2_mm.empty() || !(noise.added_rms_m > 0.0)) {
    out.reason = "the noise of the heights is not known";
    return out;
  }
  const double most = 1.0 + kSureOfNoise * 2.0 * noise.added_rms_stderr_m / noise.added_rms_m;
  const double usual_m = mean_of_known(noise.added_sigma_m);
  const auto points = static_cast<std::ptrdiff_t>(profile.size());
  double sharpest = 0.0;
  std::vector<double> slope(profile.size(), kNan);  // under the narrowest, whose noise makes it too steep at worst
  for (const double smoothing_m : kSmoothings_m) {
    const Kernel kernel(smoothing_m, profile.spacing_m);
    if (2 * kernel.reach + 1 > points) break;
    const double sigma_per_m = std::sqrt(most) * bend_sigma_per_m(kernel, noise, profile.spacing_m);
    const double independent = std::max(1.0, static_cast<double>(points) * profile.spacing_m / smoothing_m);
    const double trials = independent * static_cast<double>(kSmoothings_m.size());
    const double z = std::sqrt(chi_square_quantile(1.0 - 2.0 * kDoubt / trials, 1.0));
    std::vector<double> bend(profile.size(), kNan);
    for (std::ptrdiff_t i = kernel.reach; i + kernel.reach < points; ++i) {
      double p = 0.0, b = 0.0;
      for (std::ptrdiff_t j = -kernel.reach; j <= kernel.reach; ++j) {
        const double h_m = profile.height_m[static_cast<std::size_t>(i + j)];
        p += kernel.slope[static_cast<std::size_t>(j + kernel.reach)] * h_m;
        b += kernel.bend[static_cast<std::size_t>(j + kernel.reach)] * h_m;
      }
      if (smoothing_m == kSmoothings_m.front()) slope[static_cast<std::size_t>(i)] = p;
      bend[static_cast<std::size_t>(i)] = b;
    }
    for (std::ptrdiff_t i = kernel.reach; i + kernel.reach < points; ++i) {
      const auto at = static_cast<std::size_t>(i);
      if (!std::isfinite(bend[at])) continue;
      const double here_m = noise.added_sigma_m.empty() ? 0.0 : noise.added_sigma_m[at];
      const double sigma = sigma_per_m * (usual_m > 0.0 && here_m > 0.0 ? here_m / usual_m : 1.0);
      const double certain = -bend[at] - z * sigma;
      if (certain <= 0.0) continue;
      double steepest = 0.0;
      for (std::ptrdiff_t j = -kernel.reach; j <= kernel.reach; ++j) {
        const double p = slope[static_cast<std::size_t>(i + j)];
        if (std::isfinite(p)) steepest = std::max(steepest, std::abs(p));
      }
      const double curvature = certain / std::pow(1.0 + steepest * steepest, 1.5);
      if (curvature <= sharpest) continue;
      sharpest = curvature;
      out.at_s_m = profile.s_m[at];
      out.smoothing_m = smoothing_m;
      out.curvature_per_m = -bend[at];
      out.curvature_sigma_per_m = sigma;
    }
  }
  out.determined = sharpest > 0.0;
  if (out.determined) {
    out.at_most_m = 1.0 / sharpest;
  } else {
    out.reason = "no peak is above the noise";
  }
  return out;
}

}  // namespace asperity
