#include "asperity/texture/autoregressive_filter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <string>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/texture/series_state.h"

namespace asperity {
namespace {

using Polynomial = std::array<double, kMaxSeriesOrder + 3>;

// p times (1 − 2 cos ω z⁻¹ + z⁻²), in place; `length` coefficients become length + 2.
void multiply_pair(Polynomial& p, std::size_t& length, double cos_omega) noexcept {
  const double c = -2.0 * cos_omega;
  p[length] = 0.0;
  p[length + 1] = 0.0;
  for (std::size_t i = length + 1; i >= 2; --i) p[i] += c * p[i - 1] + p[i - 2];
  p[1] += c * p[0];
  length += 2;
}

// p times (1 + s z⁻ᵈ), d 1 or 2.
void multiply_root(Polynomial& p, std::size_t& length, double s, std::size_t d) noexcept {
  for (std::size_t i = length; i < length + d; ++i) p[i] = 0.0;
  for (std::size_t i = length + d; i-- > d;) p[i] += s * p[i - d];
  length += d;
}

// Levinson's step: the coefficients of order m become those of order m + 1.
void add_reflection(double k, std::size_t m, std::span<double> a) noexcept {
  for (std::size_t i = 0; 2 * i < m; ++i) {
    const std::size_t j = m - 1 - i;
    const double low = a[i] + k * a[j];
    a[j] = a[j] + k * a[i];
    a[i] = low;
  }
  a[m] = k;
}

// Minus the phase of z⁻¹ z⁻ᵖA(z⁻¹)/A(z) at ω, unwrapped: S_m = (k_m + u) / (1 + k_m u) with u = z⁻¹ S_{m−1}.
double allpass_lag_rad(std::span<const double> k, double omega_rad) {
  double lag = omega_rad;
  for (const double km : k) lag += omega_rad + 2.0 * std::atan2(-km * std::sin(lag), 1.0 + km * std::cos(lag));
  return lag;
}

}  // namespace

void lsf_to_ar(std::span<const double> lsf_rad, std::span<double> a) noexcept {
  const std::size_t order = lsf_rad.size();
  Polynomial sum{1.0};
  Polynomial difference{1.0};
  std::size_t sum_length = 1;
  std::size_t difference_length = 1;
  for (std::size_t i = 0; i < order; ++i) {
    if (i % 2 == 0)
      multiply_pair(sum, sum_length, std::cos(lsf_rad[i]));
    else
      multiply_pair(difference, difference_length, std::cos(lsf_rad[i]));
  }
  if (order % 2 == 0) {
    multiply_root(sum, sum_length, 1.0, 1);
    multiply_root(difference, difference_length, -1.0, 1);
  } else {
    multiply_root(difference, difference_length, -1.0, 2);
  }
  for (std::size_t i = 0; i < order; ++i) a[i] = 0.5 * (sum[i + 1] + difference[i + 1]);
}

bool ar_to_reflection(std::span<const double> a, std::span<double> k) noexcept {
  std::array<double, kMaxSeriesOrder> c;
  std::copy(a.begin(), a.end(), c.begin());
  for (std::size_t m = a.size(); m-- > 0;) {
    k[m] = c[m];
    const double scale = 1.0 - c[m] * c[m];
    if (!(scale > 0.0)) return false;
    const double km = c[m];
    const double inverse = 1.0 / scale;
    for (std::size_t i = 0; 2 * i < m; ++i) {
      const std::size_t j = m - 1 - i;
      const double low = (c[i] - km * c[j]) * inverse;
      c[j] = (c[j] - km * c[i]) * inverse;
      c[i] = low;
    }
  }
  return true;
}

void reflection_to_ar(std::span<const double> k, std::span<double> a) noexcept {
  for (std::size_t m = 0; m < k.size(); ++m) add_reflection(k[m], m, a);
}

std::vector<double> reflection_to_lsf(std::span<const double> k) {
  if (k.empty() || k.size() > kMaxSeriesOrder)
    throw Error("texture: a filter of order " + std::to_string(k.size()) + "; 1 to " + std::to_string(kMaxSeriesOrder) +
                " are possible");
  for (const double km : k) {
    if (!(std::abs(km) < 1.0)) throw Error("texture: reflection coefficient " + number_text(km) + ": unstable");
  }
  std::vector<double> lsf(k.size());
  double from = 0.0;
  for (std::size_t i = 0; i < k.size(); ++i) {
    const double target = static_cast<double>(i + 1) * std::numbers::pi;
    double low = from;
    double high = std::numbers::pi;
    for (int step = 0; step < 60; ++step) {
      const double middle = 0.5 * (low + high);
      (allpass_lag_rad(k, middle) < target ? low : high) = middle;
    }
    from = lsf[i] = 0.5 * (low + high);
  }
  return lsf;
}

std::vector<double> autocovariance(std::span<const double> k, double variance, int count) {
  const std::size_t order = k.size();
  std::vector<double> r(static_cast<std::size_t>(std::max(count, 1)));
  std::vector<double> error(order + 1);  // of the predictor of order m
  error[order] = variance;
  for (std::size_t m = order; m-- > 0;) error[m] = error[m + 1] / (1.0 - k[m] * k[m]);
  r[0] = error[0];
  std::vector<double> a(order);
  for (std::size_t m = 1; m < r.size(); ++m) {
    const std::size_t known = std::min(m - 1, order);
    if (known > 0) reflection_to_ar(k.first(known), a);
    double next = m <= order ? -k[m - 1] * error[m - 1] : 0.0;
    for (std::size_t i = 0; i < known; ++i) next -= a[i] * r[m - 1 - i];
    r[m] = next;
  }
  return r;
}

void autocorrelation(std::span<const double> k, std::span<double> r) noexcept {
  const std::size_t order = k.size();
  std::array<double, kMaxSeriesOrder> a{};
  double error = 1.0;  // of the predictor of the order so far
  if (!r.empty()) r[0] = 1.0;
  for (std::size_t m = 1; m < r.size(); ++m) {
    const std::size_t known = std::min(m - 1, order);
    double next = m <= order ? -k[m - 1] * error : 0.0;
    for (std::size_t i = 0; i < known; ++i) next -= a[i] * r[m - 1 - i];
    r[m] = next;
    if (m > order) continue;
    error *= 1.0 - k[m - 1] * k[m - 1];
    add_reflection(k[m - 1], m - 1, a);
  }
}

LevinsonResult levinson(std::span<const double> r) {
  if (r.empty() || !(r[0] > 0.0)) throw Error("texture: the series has no variance");
  const std::size_t order = r.size() - 1;
  LevinsonResult result{std::vector<double>(order), r[0]};
  std::vector<double> a(order);
  for (std::size_t m = 0; m < order; ++m) {
    double next = r[m + 1];
    for (std::size_t i = 0; i < m; ++i) next += a[i] * r[m - i];
    const double km = -next / result.variance;
    if (!(std::abs(km) < 1.0)) throw Error("texture: the autocovariance is not positive definite");
    result.k[m] = km;
    result.variance *= 1.0 - km * km;
    reflection_to_ar(std::span<const double>(result.k).first(m + 1), a);
  }
  return result;
}

double power_density(std::span<const double> a, std::span<const double> b, double gain, double variance,
                     double omega_rad) noexcept {
  const auto z = std::polar(1.0, -omega_rad);
  const auto value = [&](std::span<const double> c) {
    std::complex<double> sum = 0.0;
    for (std::size_t i = c.size(); i-- > 0;) sum = (sum + c[i]) * z;
    return std::norm(sum + 1.0);
  };
  return variance * gain * gain * value(b) / value(a);
}

}  // namespace asperity
