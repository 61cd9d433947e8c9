#include "warp_pass.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>

#include <Eigen/Core>

#include "asperity/algebra/solve.h"
#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/signal/spectrum.h"
#include "spectrum_at.h"

namespace asperity {

namespace {

constexpr std::size_t kPadding_points = 256;  // against the filter's wrap-around
constexpr int kBlurredSteps = 4;
constexpr int kWarpSteps = 12;
constexpr double kSmallStep_points = 1e-3;
constexpr double kMostNumbers = 1 << 26;  // of the equations: half a gigabyte

// A filter that makes noise of a density white, with unit variance a sample.
class Whitening {
 public:
  Whitening(const WarpTarget& target, const PassSignal& pass, std::size_t points, double blur_mm,
            const AlignPassesConfig& config)
      : n_(power_of_two(points + kPadding_points)), gain_(n_ / 2 + 1, 0.0) {
    for (std::size_t k = 1; k < gain_.size(); ++k) {
      const double f = static_cast<double>(k) / (static_cast<double>(n_) * pass.spacing_mm);
      if (f < config.low_cycles_per_mm || f > config.high_cycles_per_mm) continue;
      const double density =
          spectrum_at(target.frequency, target.noise, f) + spectrum_at(pass.frequency, pass.noise, f);
      const double phase = 2.0 * std::numbers::pi * f * blur_mm;
      if (density > 0.0) gain_[k] = std::sqrt(2.0 * pass.spacing_mm / density) * std::exp(-0.5 * phase * phase);
    }
  }

  Eigen::VectorXd operator()(const std::vector<double>& x) const {
    std::vector<double> padded(n_, 0.0);
    std::copy(x.begin(), x.end(), padded.begin());
    std::vector<std::complex<double>> spectrum = real_dft(padded);
    for (std::size_t k = 0; k < spectrum.size(); ++k) spectrum[k] *= gain_[k];
    const std::vector<double> out = inverse_real_dft(spectrum, n_);
    return Eigen::Map<const Eigen::VectorXd>(out.data(), static_cast<Eigen::Index>(n_));
  }

 private:
  std::size_t n_;
  std::vector<double> gain_;
};

// Shift, stretch and hats between the knots, each over the target's points.
std::vector<std::vector<double>> warp_shapes(std::size_t points, double knot_spacing_points) {
  const double length = static_cast<double>(points - 1);
  const double wanted = std::max(1.0, std::round(length / knot_spacing_points)) + 1.0;
  if ((wanted + 2.0) * static_cast<double>(power_of_two(points + kPadding_points)) > kMostNumbers) {
    throw Error("passes of " + std::to_string(points) + " points with " + number_text(wanted) +
                " knots are too long to be aligned; take shorter strokes, or a larger align.knot_spacing_m");
  }
  std::vector<std::vector<double>> out(2, std::vector<double>(points, 1.0));
  for (std::size_t i = 0; i < points; ++i) out[1][i] = static_cast<double>(i) / length - 0.5;
  const auto knots = static_cast<std::size_t>(wanted);
  const double spacing = length / static_cast<double>(knots - 1);
  for (std::size_t k = 0; k < knots; ++k) {
    std::vector<double>& hat = out.emplace_back(points, 0.0);
    for (std::size_t i = 0; i < points; ++i)
      hat[i] = std::max(0.0, 1.0 - std::abs(static_cast<double>(i) / spacing - static_cast<double>(k)));
  }
  return out;
}

}  // namespace

std::vector<double> warp_pass(const WarpTarget& target, const PassSignal& pass, std::span<const double> places,
                              const WarpPrior& prior, const AlignPassesConfig& config) {
  const std::size_t points = target.height_m.size();
  std::vector<double> at(places.begin(), places.end());
  const std::vector<std::vector<double>> shapes = warp_shapes(points, prior.knot_spacing_mm / pass.spacing_mm);
  const auto unknowns = static_cast<Eigen::Index>(shapes.size());
  const double sigma_points = prior.place_sigma_mm / pass.spacing_mm;
  const double last = static_cast<double>(pass.size() - 1);
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(unknowns);
  for (int step = 0; step < kWarpSteps; ++step) {
    const Whitening whiten(target, pass, points, step < kBlurredSteps ? prior.place_sigma_mm : 0.0, config);
    std::vector<double> difference_m(points, 0.0), slope_m(points, 0.0);
    for (std::size_t i = 0; i < points; ++i) {
      if (target.known[i] == 0 || at[i] < 1.0 || at[i] > last - 1.0) continue;
      difference_m[i] = height_at(pass.height_m, at[i]) - target.height_m[i];
      slope_m[i] = height_at(pass.height_m, at[i] + 0.5) - height_at(pass.height_m, at[i] - 0.5);
    }
    const Eigen::VectorXd residual = whiten(difference_m);
    Eigen::MatrixXd jacobian(residual.size(), unknowns);
    for (Eigen::Index k = 0; k < unknowns; ++k) {
      std::vector<double> column(points);
      for (std::size_t i = 0; i < points; ++i) column[i] = slope_m[i] * shapes[static_cast<std::size_t>(k)][i];
      jacobian.col(k) = whiten(column);
    }
    Eigen::MatrixXd normal = jacobian.transpose() * jacobian;
    Eigen::VectorXd gradient = jacobian.transpose() * residual;
    for (Eigen::Index k = 2; k < unknowns; ++k) {
      normal(k, k) += 1.0 / (sigma_points * sigma_points);
      gradient[k] += sum[k] / (sigma_points * sigma_points);
    }
    // Shift and stretch are also sums of the hats: what tells them apart is the prior. Without heights nothing holds
    // them.
    normal(0, 0) += 1e-9 * (1.0 + normal(0, 0));
    normal(1, 1) += 1e-9 * (1.0 + normal(1, 1));
    const Eigen::VectorXd change = -solve_symmetric(normal, gradient);
    if (!change.allFinite()) break;
    double most = 0.0;
    for (std::size_t i = 0; i < points; ++i) {
      double move = 0.0;
      for (Eigen::Index k = 0; k < unknowns; ++k) move += change[k] * shapes[static_cast<std::size_t>(k)][i];
      at[i] += move;
      most = std::max(most, std::abs(move));
    }
    sum += change;
    if (step >= kBlurredSteps && most < kSmallStep_points) break;
  }
  // A stroke does not go back.
  for (std::size_t i = 1; i < points; ++i) at[i] = std::max(at[i], at[i - 1]);
  return at;
}

}  // namespace asperity
