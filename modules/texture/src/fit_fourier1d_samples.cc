#include "asperity/texture/fit_fourier1d_samples.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <string>
#include <unsupported/Eigen/FFT>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/base/plausible_profile.h"
#include "asperity/base/rounded_text.h"
#include "asperity/base/smoothstep.h"
#include "asperity/base/text.h"
#include "asperity/texture/evaluate_fourier1d.h"

namespace asperity {
namespace {

using Complex = std::complex<double>;

// sum[n] += weight · exp(−i n θ) for n = 0…sum.size() − 1, θ = 2π·turn; by recurrence, set anew every 64 steps.
void add_powers(double turn, double weight, std::vector<Complex>& sum) {
  constexpr std::size_t kAnchor = 64;
  const Complex step = std::polar(1.0, -2.0 * std::numbers::pi * turn);
  Complex power = 0.0;
  for (std::size_t n = 0; n < sum.size(); ++n) {
    if (n % kAnchor == 0) {
      const double turns = static_cast<double>(n) * turn;
      power = std::polar(weight, -2.0 * std::numbers::pi * (turns - std::floor(turns)));
    }
    sum[n] += power;
    power = {power.real() * step.real() - power.imag() * step.imag(),
             power.real() * step.imag() + power.imag() * step.real()};
  }
}

// y = T x for the Toeplitz matrix of the first column t (Hermitian), by a circulant of twice its size.
class Toeplitz {
 public:
  explicit Toeplitz(const std::vector<Complex>& t) : size_(t.size()) {
    padded_ = 1;
    while (padded_ < 2 * size_) padded_ *= 2;
    std::vector<Complex> column(padded_);
    for (std::size_t n = 0; n < size_; ++n) {
      column[n] = t[n];
      if (n > 0) column[padded_ - n] = std::conj(t[n]);
    }
    spectrum_.resize(padded_);
    buffer_.resize(padded_);
    transform_.resize(padded_);
    fft_.fwd(spectrum_.data(), column.data(), static_cast<Eigen::Index>(padded_));
  }

  void apply(const std::vector<Complex>& x, std::vector<Complex>& y) {
    std::fill(buffer_.begin(), buffer_.end(), 0.0);
    std::copy(x.begin(), x.end(), buffer_.begin());
    fft_.fwd(transform_.data(), buffer_.data(), static_cast<Eigen::Index>(padded_));
    for (std::size_t i = 0; i < padded_; ++i) transform_[i] *= spectrum_[i];
    fft_.inv(buffer_.data(), transform_.data(), static_cast<Eigen::Index>(padded_));
    std::copy(buffer_.begin(), buffer_.begin() + static_cast<std::ptrdiff_t>(size_), y.begin());
  }

 private:
  std::size_t size_;
  std::size_t padded_ = 1;
  std::vector<Complex> spectrum_, buffer_, transform_;
  Eigen::FFT<double> fft_;
};

double dot(const std::vector<Complex>& a, const std::vector<Complex>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i].real() * b[i].real() + a[i].imag() * b[i].imag();
  return sum;
}

struct Sample {
  double turn;  // of the period, in [0, 1)
  double height_m;
};

std::vector<Sample> checked(std::span<const double> x_m, std::span<const double> height_m, double length_m) {
  if (x_m.size() != height_m.size()) {
    throw Error("texture: " + std::to_string(x_m.size()) + " positions for " + std::to_string(height_m.size()) +
                " heights");
  }
  if (!(length_m > 0.0) || !std::isfinite(length_m))
    throw Error("texture: the length " + number_text(length_m) + " m is not positive");
  std::vector<Sample> samples;
  samples.reserve(x_m.size());
  for (std::size_t i = 0; i < x_m.size(); ++i) {
    if (std::isnan(height_m[i])) continue;
    if (!std::isfinite(x_m[i]) || !std::isfinite(height_m[i])) {
      throw Error("texture: height " + std::to_string(i + 1) + ", " + number_text(height_m[i]) + " m at " +
                  number_text(x_m[i]) + " m, is not finite");
    }
    const double turns = x_m[i] / length_m;
    samples.push_back({turns - std::floor(turns), height_m[i]});
  }
  return samples;
}

// Fills each run of nan of a closed profile (its end is followed by its start) so that height and slope go on over
// both edges: from either side a line that bends to level within 0.15 mm, blended. What a series may do in a gap
// where no height counts is ring at its highest frequencies.
void bridge_gaps_round(std::vector<double>& z_m, double spacing_m) {
  constexpr double kBend_m = 0.15e-3;
  const std::size_t n = z_m.size();
  std::size_t first = 0;
  while (first < n && !std::isfinite(z_m[first])) ++first;
  if (first == n) return;
  const std::vector<double> source = z_m;
  const auto at = [&](std::size_t i) { return source[i % n]; };
  // One-sided, over the neighbour if it is there.
  const auto slope = [&](std::size_t edge, std::size_t inner) {
    return std::isfinite(at(inner)) ? (at(edge) - at(inner)) / spacing_m : 0.0;
  };
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t left = first + k;
    if (!std::isfinite(at(left)) || std::isfinite(at(left + 1))) continue;
    std::size_t right = left + 1;
    while (!std::isfinite(at(right))) ++right;
    const double length_m = static_cast<double>(right - left) * spacing_m;
    const double from_left = slope(left, left + n - 1), from_right = slope(right, right + 1);
    for (std::size_t i = left + 1; i < right; ++i) {
      const double a_m = static_cast<double>(i - left) * spacing_m, b_m = length_m - a_m;
      const double weight = smoothstep(a_m / length_m);
      z_m[i % n] = (1.0 - weight) * (at(left) + from_left * a_m * std::exp(-a_m / kBend_m)) +
                   weight * (at(right) + from_right * b_m * std::exp(-b_m / kBend_m));
    }
  }
}

}  // namespace

FourierSamplesFit fit_fourier1d_samples(std::span<const double> x_m, std::span<const double> height_m, double length_m,
                                        const FitFourier1dSamplesConfig& config) {
  const auto samples = checked(x_m, height_m, length_m);
  if (config.coefficients < 1)
    throw Error("texture: " + std::to_string(config.coefficients) + " coefficients; at least one is needed");
  const auto count = static_cast<std::size_t>(config.coefficients);
  if (samples.size() <= 2 * count) {
    throw Error("texture: " + std::to_string(count) + " coefficients need more than " + std::to_string(2 * count) +
                " heights; there are " + std::to_string(samples.size()));
  }
  const double weight = 1.0 / static_cast<double>(samples.size());
  double mean_m = 0.0;
  for (const Sample& s : samples) mean_m += weight * s.height_m;

  // T's first column, and the right-hand side for j = 0…N; that for −j is its conjugate.
  std::vector<Complex> column(2 * count + 1), half(count + 1);
  for (const Sample& s : samples) {
    add_powers(s.turn, weight, column);
    add_powers(s.turn, weight * (s.height_m - mean_m), half);
  }
  std::vector<Complex> right(2 * count + 1);
  for (std::size_t j = 0; j <= count; ++j) {
    right[count + j] = half[j];
    right[count - j] = std::conj(half[j]);
  }
  Toeplitz toeplitz(column);
  std::vector<Complex> c(right.size()), residual = right, direction = right, image(right.size());
  const double scale = dot(right, right);
  double square = scale;
  FourierSamplesFit fit;
  constexpr double kTolerance = 1e-12;
  while (fit.iterations < config.iterations && square > kTolerance * kTolerance * scale) {
    toeplitz.apply(direction, image);
    for (std::size_t j = 0; j < c.size(); ++j) {
      if (j != count) image[j] += config.ridge * direction[j];
    }
    const double along = dot(direction, image);
    if (!(along > 0.0)) break;
    const double alpha = square / along;
    for (std::size_t j = 0; j < c.size(); ++j) c[j] += alpha * direction[j], residual[j] -= alpha * image[j];
    const double next = dot(residual, residual);
    for (std::size_t j = 0; j < c.size(); ++j) direction[j] = residual[j] + next / square * direction[j];
    square = next;
    ++fit.iterations;
  }
  fit.relative_residual = scale > 0.0 ? std::sqrt(square / scale) : 0.0;
  fit.texture.length_mm = length_m * 1e3;
  fit.texture.mean_m = mean_m + c[count].real();
  for (std::size_t j = 1; j <= count; ++j) {
    fit.texture.a_m.push_back(c[count + j].real() + c[count - j].real());
    fit.texture.b_m.push_back(c[count - j].imag() - c[count + j].imag());
  }
  double error = 0.0;
  double height = 0.0;
  for (const Sample& s : samples) {
    error += std::pow(evaluate_height(fit.texture, s.turn * length_m).height_m - s.height_m, 2);
    height += std::pow(s.height_m - mean_m, 2);
  }
  fit.rms_error_m = std::sqrt(weight * error);
  fit.rms_height_m = std::sqrt(weight * height);
  return fit;
}

FourierPathFit fit_fourier1d_path(std::span<const double> height_m, double spacing_m,
                                  const FitFourier1dPathConfig& config) {
  require_plausible_spacing(spacing_m, "texture");
  require_plausible_heights(height_m, "texture");
  const auto seam = static_cast<std::size_t>(std::lround(config.seam_mm * 1e-3 / spacing_m));
  std::vector<double> closed_m(height_m.begin(), height_m.end());
  closed_m.resize(height_m.size() + seam, std::numeric_limits<double>::quiet_NaN());
  bridge_gaps_round(closed_m, spacing_m);
  std::vector<double> x_m(closed_m.size());
  for (std::size_t i = 0; i < x_m.size(); ++i) x_m[i] = static_cast<double>(i) * spacing_m;
  const double length_m = static_cast<double>(x_m.size()) * spacing_m;
  const auto missing = std::count_if(height_m.begin(), height_m.end(), [](double z) { return std::isnan(z); });
  const auto present = static_cast<double>(height_m.size()) - static_cast<double>(missing);
  const double wanted = std::round(config.coefficients_per_mm * length_m * 1e3);
  // Half a sample a wave is lost to noise before the samples end.
  const double possible = std::floor((present - 1.0) / 2.5);
  FourierPathFit result;
  FitFourier1dSamplesConfig samples;
  samples.coefficients =
      static_cast<int>(std::max(1.0, std::min({wanted, possible, static_cast<double>(config.most_coefficients)})));
  samples.ridge = config.ridge;
  if (samples.coefficients < static_cast<int>(std::min(wanted, 1e9))) {
    result.problems.push_back({"coarse_texture",
                               "the path is limited to " +
                                   rounded_text(static_cast<double>(samples.coefficients) / (length_m * 1e3)) +
                                   " cycles/mm instead of " + rounded_text(config.coefficients_per_mm),
                               1});
  }
  result.fit = fit_fourier1d_samples(x_m, closed_m, length_m, samples);
  result.height_offset_m = height_offset_m(result.fit.texture);
  return result;
}

}  // namespace asperity
