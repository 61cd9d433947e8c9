#include "warp_pass.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "asperity/algebra/solve.h"
#include "asperity/base/error.h"
#include "asperity/base/nan.h"
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

constexpr int kHalvings = 6;
constexpr double kMostFolded = 0.01;  // of the points
constexpr double kLeastKept = 0.5;    // of the points that the two shared at first

// The density of what two differ by, where both are known; empty: they share too little.
struct ShownNoise {
  std::vector<double> frequency, density;
};

// A filter that makes noise of a density white, with unit variance a sample.
class Whitening {
 public:
  Whitening(const WarpTarget& target, const PassSignal& pass, const ShownNoise& shown, std::size_t points,
            double blur_mm, const AlignPassesConfig& config)
      : n_(power_of_two(points + kPadding_points)), gain_(n_ / 2 + 1, 0.0) {
    for (std::size_t k = 1; k < gain_.size(); ++k) {
      const double f = static_cast<double>(k) / (static_cast<double>(n_) * pass.spacing_mm);
      if (f < config.low_cycles_per_mm || f > config.high_cycles_per_mm) continue;
      double density = spectrum_at(target.frequency, target.noise, f) + spectrum_at(pass.frequency, pass.noise, f);
      if (!shown.density.empty()) density = std::max(density, spectrum_at(shown.frequency, shown.density, f));
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
    std::vector<double> hat(points, 0.0);
    for (std::size_t i = 0; i < points; ++i)
      hat[i] = std::max(0.0, 1.0 - std::abs(static_cast<double>(i) / spacing - static_cast<double>(k)));
    out.push_back(std::move(hat));
  }
  return out;
}

class Warp {
 public:
  Warp(const WarpTarget& target, const PassSignal& pass, const WarpPrior& prior, const AlignPassesConfig& config)
      : target_(target),
        pass_(pass),
        config_(config),
        place_sigma_mm_(prior.place_sigma_mm),
        weight_(1.0 / std::pow(prior.place_sigma_mm / pass.spacing_mm, 2)),
        shapes_(warp_shapes(target.height_m.size(), prior.knot_spacing_mm / pass.spacing_mm)),
        unknowns_(static_cast<Eigen::Index>(shapes_.size())) {}

  WarpedPlaces run(std::span<const double> places) {
    const std::size_t points = target_.height_m.size();
    WarpedPlaces out{{places.begin(), places.end()}, true};
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(unknowns_);
    const std::size_t shared = shared_points(out.places);
    for (int step = 0; step < kWarpSteps; ++step) {
      const Whitening whiten(target_, pass_, shown_noise(out.places), points,
                             step < kBlurredSteps ? place_sigma_mm_ : 0.0, config_);
      const Eigen::VectorXd change = solve_step(whiten, out.places, sum);
      if (!change.allFinite()) {
        out.converged = false;
        break;
      }
      std::vector<double> move(points, 0.0);
      for (std::size_t i = 0; i < points; ++i) {
        for (Eigen::Index k = 0; k < unknowns_; ++k) move[i] += change[k] * shapes_[static_cast<std::size_t>(k)][i];
      }
      const double share = shortened(whiten, out.places, move, sum, change, shared);
      if (share == 0.0) {
        if (step >= kBlurredSteps) break;
        step = kBlurredSteps - 1;  // by the long waves there is nothing better
        continue;
      }
      double most = 0.0;
      for (const double of_point : move) most = std::max(most, share * std::abs(of_point));
      for (std::size_t i = 0; i < points; ++i) out.places[i] += share * move[i];
      sum += share * change;
      if (step >= kBlurredSteps && most < kSmallStep_points) break;
    }
    // A stroke does not go back.
    std::size_t folded = 0;
    for (std::size_t i = 1; i < points; ++i) {
      folded += out.places[i] < out.places[i - 1] ? 1 : 0;
      out.places[i] = std::max(out.places[i], out.places[i - 1]);
    }
    const double slope = (out.places.back() - out.places.front()) / (places.back() - places.front());
    if (static_cast<double>(folded) > kMostFolded * static_cast<double>(points) || !keeps(out.places, shared) ||
        !(std::abs(slope - 1.0) <= std::max(config_.max_stretch, kLeastStretch)))
      out.converged = false;
    return out;
  }

 private:
  // Beyond the stretches that are searched, on top of the one that was found, the places ran away.
  static constexpr double kLeastStretch = 0.01;

  bool is_shared(std::size_t i, double place) const {
    return target_.known[i] != 0 && place >= 1.0 && place <= static_cast<double>(pass_.size() - 1) - 1.0;
  }

  std::size_t shared_points(const std::vector<double>& at) const {
    std::size_t out = 0;
    for (std::size_t i = 0; i < at.size(); ++i) out += is_shared(i, at[i]) ? 1 : 0;
    return out;
  }

  std::vector<double> difference_m(const std::vector<double>& at) const {
    std::vector<double> out(at.size(), 0.0);
    for (std::size_t i = 0; i < at.size(); ++i) {
      if (is_shared(i, at[i])) out[i] = height_at(pass_.height_m, at[i]) - target_.height_m[i];
    }
    return out;
  }

  // The part of a step that makes the fit no worse; 0: none does.
  double shortened(const Whitening& whiten, const std::vector<double>& places, const std::vector<double>& move,
                   const Eigen::VectorXd& sum, const Eigen::VectorXd& change, std::size_t shared) const {
    const double before = cost(whiten, places, sum);
    double share = 1.0;
    for (int halving = 0; halving <= kHalvings; ++halving, share *= 0.5) {
      std::vector<double> at = places;
      for (std::size_t i = 0; i < at.size(); ++i) at[i] += share * move[i];
      // Points that leave the pass would make any fit better.
      if (keeps(at, shared) && cost(whiten, at, sum + share * change) <= before) return share;
    }
    return 0.0;
  }

  bool keeps(const std::vector<double>& at, std::size_t shared) const {
    return static_cast<double>(shared_points(at)) >= kLeastKept * static_cast<double>(shared);
  }

  double cost(const Whitening& whiten, const std::vector<double>& at, const Eigen::VectorXd& sum) const {
    return whiten(difference_m(at)).squaredNorm() + weight_ * sum.tail(unknowns_ - 2).squaredNorm();
  }

  ShownNoise shown_noise(const std::vector<double>& at) const {
    if (target_.states_noise && pass_.states_noise) return {};
    std::vector<double> both;
    for (std::size_t i = 0; i < at.size(); ++i) {
      if (is_shared(i, at[i])) both.push_back(height_at(pass_.height_m, at[i]) - target_.height_m[i]);
    }
    if (both.size() < kPassSegment_points / 4) return {};
    const PowerSpectrum spectrum = welch(both, 1.0 / pass_.spacing_mm, std::min(kPassSegment_points, both.size()));
    return {spectrum.frequency, spectrum.density};
  }

  Eigen::VectorXd solve_step(const Whitening& whiten, const std::vector<double>& at, const Eigen::VectorXd& sum) const {
    const std::size_t points = at.size();
    std::vector<double> slope_m(points, 0.0);
    for (std::size_t i = 0; i < points; ++i) {
      if (is_shared(i, at[i]))
        slope_m[i] = height_at(pass_.height_m, at[i] + 0.5) - height_at(pass_.height_m, at[i] - 0.5);
    }
    const Eigen::VectorXd residual = whiten(difference_m(at));
    Eigen::MatrixXd jacobian(residual.size(), unknowns_);
    for (Eigen::Index k = 0; k < unknowns_; ++k) {
      std::vector<double> column(points);
      for (std::size_t i = 0; i < points; ++i) column[i] = slope_m[i] * shapes_[static_cast<std::size_t>(k)][i];
      jacobian.col(k) = whiten(column);
    }
    Eigen::MatrixXd normal = jacobian.transpose() * jacobian;
    Eigen::VectorXd gradient = jacobian.transpose() * residual;
    for (Eigen::Index k = 2; k < unknowns_; ++k) {
      normal(k, k) += weight_;
      gradient[k] += weight_ * sum[k];
    }
    // Shift and stretch are also sums of the hats: what tells them apart is the prior. Without heights nothing holds
    // them.
    normal(0, 0) += 1e-9 * (1.0 + normal(0, 0));
    normal(1, 1) += 1e-9 * (1.0 + normal(1, 1));
    if (!normal.allFinite() || !gradient.allFinite()) return Eigen::VectorXd::Constant(unknowns_, kNan);
    return -solve_symmetric(normal, gradient);
  }

  const WarpTarget& target_;
  const PassSignal& pass_;
  const AlignPassesConfig& config_;
  double place_sigma_mm_, weight_;
  std::vector<std::vector<double>> shapes_;
  Eigen::Index unknowns_;
};

}  // namespace

WarpedPlaces warp_pass(const WarpTarget& target, const PassSignal& pass, std::span<const double> places,
                       const WarpPrior& prior, const AlignPassesConfig& config) {
  return Warp(target, pass, prior, config).run(places);
}

}  // namespace asperity
