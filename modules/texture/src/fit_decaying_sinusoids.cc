#include "asperity/texture/fit_decaying_sinusoids.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>

#include <Eigen/Core>

#include "asperity/algebra/solve.h"
#include "asperity/base/error.h"
#include "asperity/base/text.h"

namespace asperity {
namespace {

constexpr Eigen::Index kMostLags = 96;

// a, b, B, ω.
using Parameters = Eigen::Vector4d;

void check_taps(const std::vector<TapRecording>& taps, const FitDecayingSinusoidsConfig& config) {
  if (taps.empty()) throw Error("texture: no taps");
  if (!(config.rate_Hz > 0.0) || !std::isfinite(config.rate_Hz))
    throw Error("texture: the rate " + number_text(config.rate_Hz) + " Hz is not positive");
  double square = 0.0;
  for (std::size_t i = 0; i < taps.size(); ++i) {
    const auto& tap = taps[i];
    const std::string what = "texture: tap " + std::to_string(i + 1);
    if (tap.acceleration_mps2.size() < 16)
      throw Error(what + " has " + std::to_string(tap.acceleration_mps2.size()) + " samples; 16 are needed");
    if (!std::isfinite(tap.speed_mps) || !std::isfinite(tap.force_N) || tap.speed_mps < 0.0 || tap.force_N < 0.0)
      throw Error(what + " has speed " + number_text(tap.speed_mps) + " m/s and force " + number_text(tap.force_N) +
                  " N");
    for (const double x : tap.acceleration_mps2) {
      if (!std::isfinite(x)) throw Error(what + " has a sample that is not finite");
      square += x * x;
    }
  }
  if (!(square > 0.0)) throw Error("texture: the taps are silent");
}

// The pole z = e^((−B + iω)/rate) that all taps share: the two strongest directions of the lags' covariance, shifted by
// one.
std::complex<double> common_pole(const std::vector<TapRecording>& taps) {
  std::size_t shortest = taps.front().acceleration_mps2.size();
  for (const auto& tap : taps) shortest = std::min(shortest, tap.acceleration_mps2.size());
  const Eigen::Index lags = std::min<Eigen::Index>(kMostLags, static_cast<Eigen::Index>(shortest) / 2);
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(lags, lags);
  for (const auto& tap : taps) {
    const Eigen::Map<const Eigen::VectorXd> x(tap.acceleration_mps2.data(),
                                              static_cast<Eigen::Index>(tap.acceleration_mps2.size()));
    for (Eigen::Index i = 0; i + lags <= x.size(); ++i)
      covariance.selfadjointView<Eigen::Lower>().rankUpdate(x.segment(i, lags));
  }
  const Eigen::MatrixXd signal = symmetric_eigen(covariance).vectors.rightCols<2>();
  const Eigen::Matrix2d shift = least_squares(signal.topRows(lags - 1), signal.bottomRows(lags - 1)).x;
  return eigenvalues(shift)[0];
}

// The wave of unit amplitude and its derivatives with B and ω.
struct Wave {
  double q, by_decay, by_omega;
};

Wave wave(double t, const Parameters& p) {
  const double e = std::exp(-p[2] * t);
  const double s = e * std::sin(p[3] * t);
  return {s, -t * s, t * e * std::cos(p[3] * t)};
}

double cost(const std::vector<TapRecording>& taps, double rate_Hz, const Parameters& p) {
  double sum = 0.0;
  for (const auto& tap : taps) {
    const double amplitude = p[0] * tap.speed_mps + p[1] * tap.force_N;
    for (std::size_t i = 0; i < tap.acceleration_mps2.size(); ++i) {
      const double r = tap.acceleration_mps2[i] - amplitude * wave(static_cast<double>(i) / rate_Hz, p).q;
      sum += r * r;
    }
  }
  return sum;
}

// Best a and b for the given B and ω; of equally good ones the shortest, in units of the taps' RMS speed and force.
bool solve_amplitudes(const std::vector<TapRecording>& taps, double rate_Hz, Parameters& p) {
  Eigen::MatrixXd m(static_cast<Eigen::Index>(taps.size()), 2);
  Eigen::VectorXd y(m.rows());
  for (Eigen::Index i = 0; i < m.rows(); ++i) {
    const auto& tap = taps[static_cast<std::size_t>(i)];
    double qq = 0.0;
    double qx = 0.0;
    for (std::size_t j = 0; j < tap.acceleration_mps2.size(); ++j) {
      const double q = wave(static_cast<double>(j) / rate_Hz, p).q;
      qq += q * q;
      qx += q * tap.acceleration_mps2[j];
    }
    const double weight = std::sqrt(qq);
    m.row(i) << weight * tap.speed_mps, weight * tap.force_N;
    y[i] = weight > 0.0 ? qx / weight : 0.0;
  }
  Eigen::Vector2d unit = m.colwise().norm();
  for (double& u : unit) u = u > 0.0 ? 1.0 / u : 0.0;
  const Eigen::MatrixXd scaled = m * unit.asDiagonal();
  const LeastSquares fit = least_squares(scaled, y, 1e-6);
  const Eigen::Vector2d x = fit.x;
  p[0] = x[0] * unit[0];
  p[1] = x[1] * unit[1];
  return fit.rank == 2;
}

// Steps of Levenberg and Marquardt on B and ω, a and b solved anew at each (variable projection).
void refine_parameters(const std::vector<TapRecording>& taps, const FitDecayingSinusoidsConfig& config, Parameters& p,
                       DecayingSinusoidsFit& fit) {
  double best = cost(taps, config.rate_Hz, p);
  double damping = 1e-3;
  for (fit.iterations = 0; fit.iterations < config.max_iterations; ++fit.iterations) {
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (const auto& tap : taps) {
      const double amplitude = p[0] * tap.speed_mps + p[1] * tap.force_N;
      for (std::size_t i = 0; i < tap.acceleration_mps2.size(); ++i) {
        const Wave w = wave(static_cast<double>(i) / config.rate_Hz, p);
        // A common gain joins B and ω, so that their step is one at free amplitude.
        const Eigen::Vector3d j(amplitude * w.by_decay, amplitude * w.by_omega, amplitude * w.q);
        normal += j * j.transpose();
        right += j * (tap.acceleration_mps2[i] - amplitude * w.q);
      }
    }
    Eigen::Matrix3d damped = normal;
    damped.diagonal() *= 1.0 + damping;
    const Eigen::Vector3d step = solve_symmetric(damped, right);
    Parameters next = p;
    next[2] += step[0];
    next[3] += step[1];
    const bool usable = step.allFinite() && next[3] > 0.0;
    if (usable) fit.speed_and_force_determined = solve_amplitudes(taps, config.rate_Hz, next);
    const double cost_next = usable ? cost(taps, config.rate_Hz, next) : best;
    const double size = std::hypot(step[0], step[1]) / std::hypot(p[2], p[3]);
    if (usable && cost_next <= best) {
      const bool stalled = best - cost_next <= 1e-12 * best;
      p = next;
      best = cost_next;
      damping *= 0.3;
      if (stalled || size < 1e-10) fit.converged = true;
    } else {
      damping *= 10.0;
      // No shorter step lowers it: rounding decides.
      if (size < 1e-10 || damping > 1e12) fit.converged = true;
    }
    if (fit.converged) break;
  }
}

void measure_fit(const std::vector<TapRecording>& taps, const Parameters& p, double rate_Hz,
                 DecayingSinusoidsFit& fit) {
  double square = 0.0;
  double error = 0.0;
  double count = 0.0;
  for (const auto& tap : taps) {
    double own = 0.0;
    double qq = 0.0;
    double qx = 0.0;
    const double amplitude = p[0] * tap.speed_mps + p[1] * tap.force_N;
    for (std::size_t i = 0; i < tap.acceleration_mps2.size(); ++i) {
      const double x = tap.acceleration_mps2[i];
      const double q = wave(static_cast<double>(i) / rate_Hz, p).q;
      square += x * x;
      own += (x - amplitude * q) * (x - amplitude * q);
      qq += q * q;
      qx += q * x;
    }
    const double n = static_cast<double>(tap.acceleration_mps2.size());
    fit.tap_error_mps2.push_back(std::sqrt(own / n));
    fit.amplitude_mps2.push_back(qq > 0.0 ? qx / qq : 0.0);
    error += own;
    count += n;
  }
  fit.rms_mps2 = std::sqrt(square / count);
  fit.rms_error_mps2 = std::sqrt(error / count);
}

}  // namespace

DecayingSinusoidsFit fit_decaying_sinusoids(const std::vector<TapRecording>& taps,
                                            const FitDecayingSinusoidsConfig& config) {
  check_taps(taps, config);
  const auto pole = common_pole(taps);
  Parameters p(0.0, 0.0, -std::log(std::abs(pole)) * config.rate_Hz, std::abs(std::arg(pole)) * config.rate_Hz);
  if (!p.allFinite() || !(p[3] > 0.0) || !(p[3] < std::numbers::pi * config.rate_Hz * (1.0 - 1e-9))) {
    throw Error("texture: the taps do not oscillate between 0 and half the rate of " + number_text(config.rate_Hz) +
                " Hz");
  }
  DecayingSinusoidsFit fit;
  fit.speed_and_force_determined = solve_amplitudes(taps, config.rate_Hz, p);
  refine_parameters(taps, config, p, fit);
  measure_fit(taps, p, config.rate_Hz, fit);
  fit.texture = {p[0], p[1], p[2], p[3], config.mass_kg, 0.0, 0.0};
  if (!fit.speed_and_force_determined) {
    fit.problems.push_back({"not_determined",
                            "the taps' speed and force rise together: how much of the amplitude is due to each is not "
                            "determined",
                            taps.size()});
  }
  if (!(p[2] > 0.0)) {
    fit.texture.decay_per_s = 0.0;
    fit.converged = false;
  }
  return fit;
}

}  // namespace asperity
