#include "asperity/texture/areal_spectrum.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "asperity/base/error.h"

namespace asperity {
namespace {

constexpr double kPi = std::numbers::pi;

// ∫₀^∞ κ² dx / (x² + 2 t κ² x + κ⁴).
double angle_of(double t) {
  if (std::abs(t - 1.0) < 1e-6) return 1.0;
  return t < 1.0 ? std::acos(t) / std::sqrt(1.0 - t * t) : std::acosh(t) / std::sqrt(t * t - 1.0);
}

// Sums of f over the sections' frequencies, even in log q, from far below κ to far above.
template <class F>
double over_section(const ArealSpectrum& s, const F& f) {
  constexpr int kSteps = 600;
  const double from = std::log(1e-3 * s.kappa_per_mm), step = std::log(1e6) / kSteps;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double q = std::exp(from + (i + 0.5) * step);
    sum += f(q) * q * step;
  }
  return sum;
}

}  // namespace

double ArealSpectrum::variance_m2() const { return A / (4.0 * kPi * kappa_per_mm * kappa_per_mm) * angle_of(t); }

double ArealSpectrum::section_m2mm(double q_per_mm) const {
  const double q2 = q_per_mm * q_per_mm, k2 = kappa_per_mm * kappa_per_mm;
  const double product = std::sqrt(q2 * q2 + 2.0 * t * k2 * q2 + k2 * k2);
  return A / (2.0 * product * std::sqrt(2.0 * (q2 + t * k2 + product)));
}

double ArealSpectrum::covariance_m2(double distance_mm) const {
  if (!(distance_mm > 0.0)) return variance_m2();
  // A section's covariance is the cosine transform of its density: smooth, and no Bessel functions.
  const double step = std::min(0.02 * kappa_per_mm, 0.1 / distance_mm), end = 60.0 * kappa_per_mm;
  double sum = 0.0;
  for (double q = 0.5 * step; q < end; q += step) sum += section_m2mm(q) * std::cos(q * distance_mm);
  return sum * step / kPi;
}

double ArealSpectrum::distance_mm(double correlation) const {
  const double level = correlation * variance_m2(), step = 0.02 / kappa_per_mm;
  double before = variance_m2();
  for (int i = 1; i < 1000; ++i) {
    const double here = covariance_m2(i * step);
    if (here < level) return step * (i - (level - here) / std::max(before - here, 1e-300));
    before = here;
  }
  return 1000 * step;
}

double ArealSpectrum::independent_mm() const {
  const double variance = variance_m2();
  const double square = over_section(*this, [&](double q) { return std::pow(section_m2mm(q), 2); }) / kPi;
  return square / (variance * variance);
}

double ArealSpectrum::frequency_cycles_per_mm(double part) const {
  const double all = kPi * variance_m2();
  constexpr int kSteps = 2000;
  const double from = std::log(1e-3 * kappa_per_mm), step = std::log(1e6) / kSteps;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double q = std::exp(from + (i + 0.5) * step);
    sum += section_m2mm(q) * q * step;
    if (sum >= part * all) return q / (2.0 * kPi);
  }
  return std::exp(from + kSteps * step) / (2.0 * kPi);
}

ArealSpectrum fit_areal_spectrum(std::span<const double> frequency_cycles_per_mm,
                                 std::span<const double> density_m2mm) {
  const std::size_t n = frequency_cycles_per_mm.size();
  if (n < 4 || density_m2mm.size() != n) throw Error("texture: a spectrum of " + std::to_string(n) + " frequencies");
  ArealSpectrum best;
  double least = std::numeric_limits<double>::infinity();
  const auto attempt = [&](double kappa, double t) {
    ArealSpectrum s{1.0, kappa, t};
    double mean = 0.0, logs = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      const double shape = 2.0 * s.section_m2mm(2.0 * kPi * frequency_cycles_per_mm[i]);
      mean += density_m2mm[i] / shape / static_cast<double>(n);
      logs += std::log(shape) / static_cast<double>(n);
    }
    // A is the mean of I/shape; what is left of the likelihood is log A and the shape's logarithm.
    const double value = std::log(std::max(mean, 1e-300)) + logs;
    if (value < least) {
      least = value;
      s.A = mean;
      best = s;
    }
  };
  const double low = 2.0 * kPi * frequency_cycles_per_mm.front(), high = 2.0 * kPi * frequency_cycles_per_mm.back();
  constexpr int kCoarse = 40;
  for (int i = 0; i <= kCoarse; ++i) {
    const double kappa = 0.5 * low * std::pow(2.0 * high / low, static_cast<double>(i) / kCoarse);
    for (const double t : {-0.97, -0.9, -0.8, -0.6, -0.4, -0.2, 0.0, 0.25, 0.5, 1.0, 2.0}) attempt(kappa, t);
  }
  double ratio = std::pow(2.0 * high / low, 1.0 / kCoarse), width = 0.1;
  for (int round = 0; round < 24; ++round) {
    const ArealSpectrum centre = best;
    for (const double f : {1.0 / ratio, 1.0, ratio})
      for (const double d : {-width, 0.0, width})
        attempt(centre.kappa_per_mm * f, std::clamp(centre.t + d * (1.0 + centre.t), -0.97, 3.0));
    ratio = std::sqrt(ratio);
    width *= 0.7;
  }
  return best;
}

}  // namespace asperity
