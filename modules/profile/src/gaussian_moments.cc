#include "gaussian_moments.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include <Eigen/Core>

#include "asperity/signal/spectrum.h"

namespace asperity {

GaussianMoments::GaussianMoments(std::size_t count, double spacing_m, double width_m, int degree) : count_(count) {
  constexpr double kReach = 2.1289340388624525;  // widths: √(π/ln 2), a cut-off of the linear filter
  reach_ = static_cast<std::size_t>(std::min(std::ceil(kReach * width_m / spacing_m), static_cast<double>(count)));
  for (std::size_t k = 0; k <= 2 * reach_; ++k) {
    const double x = (static_cast<double>(k) - static_cast<double>(reach_)) * spacing_m / width_m;
    kernel_.push_back(std::exp(-std::numbers::pi * x * x) * std::pow(x, degree));
  }
  constexpr std::size_t kShort = 64;
  if (reach_ <= kShort) return;
  padded_ = 2 * smooth_length((count_ + reach_ + 1) / 2);  // even: those are transformed fastest
  std::vector<double> wrapped(padded_, 0.0);
  // Correlation: the kernel is reversed. What wraps round meets the padding.
  for (std::size_t k = 0; k <= 2 * reach_; ++k) wrapped[(padded_ + reach_ - k) % padded_] += kernel_[k];
  spectrum_ = real_dft(wrapped);
}

double GaussianMoments::at(std::span<const double> v, std::size_t i) const {
  const std::size_t first = i < reach_ ? reach_ - i : 0;
  const std::size_t last = std::min(2 * reach_, count_ - 1 - i + reach_);
  double sum = 0.0;
  for (std::size_t k = first; k <= last; ++k) sum += kernel_[k] * v[i + k - reach_];
  return sum;
}

double GaussianMoments::total() const { return std::accumulate(kernel_.begin(), kernel_.end(), 0.0); }

std::vector<double> GaussianMoments::of(std::span<const double> v) const {
  std::vector<double> out(count_, 0.0);
  if (spectrum_.empty()) {
    // Of each the same sum in the same order; where the weight is whole, of all of them together.
    const std::size_t first = std::min(reach_, count_), last = std::max(first, count_ - first);
    for (std::size_t i = 0; i < first; ++i) out[i] = at(v, i);
    for (std::size_t i = last; i < count_; ++i) out[i] = at(v, i);
    const auto inside = static_cast<Eigen::Index>(last - first);
    Eigen::Map<Eigen::ArrayXd> sums(out.data() + first, inside);
    for (std::size_t k = 0; inside > 0 && k <= 2 * reach_; ++k)
      sums += kernel_[k] * Eigen::Map<const Eigen::ArrayXd>(v.data() + first + k - reach_, inside);
    return out;
  }
  std::vector<double> padded(padded_, 0.0);
  std::copy(v.begin(), v.end(), padded.begin());
  auto half = real_dft(padded);
  for (std::size_t k = 0; k < half.size(); ++k) half[k] *= spectrum_[k];
  padded = inverse_real_dft(half, padded_);
  std::copy_n(padded.begin(), count_, out.begin());
  return out;
}

}  // namespace asperity
