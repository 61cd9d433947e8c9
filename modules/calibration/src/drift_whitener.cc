#include "drift_whitener.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace asperity {

namespace {

// Position (and rate) of the drift, its covariance in units of the white noise's variance.
struct State {
  Eigen::RowVectorXd value, rate;
  double vv = 0.0, vr = 0.0, rr = 0.0;
  int seen = 0;
};

}  // namespace

Whitened whiten_series(DriftKind kind, const std::vector<double>& t_s, const std::vector<std::uint8_t>& starts,
                       double ratio, const Eigen::MatrixXd& columns) {
  const bool second = kind == DriftKind::kIntegratedRandomWalk;
  const int taken = second ? 2 : 1;
  Whitened out;
  out.rows = Eigen::MatrixXd::Zero(columns.rows(), columns.cols());
  State s;
  Eigen::RowVectorXd innovation(columns.cols());
  for (Eigen::Index i = 0; i < columns.rows(); ++i) {
    const double step = i > 0 ? t_s[static_cast<std::size_t>(i)] - t_s[static_cast<std::size_t>(i - 1)] : 0.0;
    if (i == 0 || starts[static_cast<std::size_t>(i)] != 0) {
      s.value = columns.row(i);
      s.rate = Eigen::RowVectorXd::Zero(columns.cols());
      s.vv = 1.0;
      s.vr = s.rr = 0.0;
      s.seen = 1;
      continue;
    }
    if (second && s.seen == 1) {
      // Two samples give the rate by their difference, and leave nothing over.
      s.rate = (columns.row(i) - s.value) / step;
      s.value = columns.row(i);
      s.vv = 1.0;
      s.vr = 1.0 / step;
      s.rr = 2.0 / (step * step) + ratio * step / 3.0;
      s.seen = 2;
      continue;
    }
    if (second) {
      s.value += step * s.rate;
      s.vv += step * (2.0 * s.vr + step * s.rr) + ratio * step * step * step / 3.0;
      s.vr += step * s.rr + ratio * step * step / 2.0;
      s.rr += ratio * step;
    } else {
      s.vv += ratio * step;
    }
    const double variance = s.vv + 1.0;
    innovation = columns.row(i) - s.value;
    out.rows.row(i) = innovation / std::sqrt(variance);
    out.log_determinant += std::log(variance);
    ++out.count;
    s.value += s.vv / variance * innovation;
    if (second) {
      s.rate += s.vr / variance * innovation;
      s.rr -= s.vr * s.vr / variance;
      s.vr -= s.vr * s.vv / variance;
    }
    s.vv -= s.vv * s.vv / variance;
    s.seen = taken + 1;
  }
  return out;
}

double most_likely_ratio(DriftKind kind, const std::vector<double>& t_s, const std::vector<std::uint8_t>& starts,
                         const Eigen::MatrixXd& residual) {
  const auto cost = [&](double log_ratio) {
    const Whitened w = whiten_series(kind, t_s, starts, std::exp(log_ratio), residual);
    const double square = w.rows.squaredNorm();
    return square > 0.0 ? w.log_determinant + w.count * std::log(square) : -std::numeric_limits<double>::infinity();
  };
  // From a drift that a day would not show to one that hides the white noise from sample to sample; in units of
  // the mean step.
  const double step = (t_s.back() - t_s.front()) / static_cast<double>(t_s.size() - 1);
  const double unit = -(kind == DriftKind::kRandomWalk ? 1.0 : 3.0) * std::log(step);
  constexpr double kLow = -32.0, kHigh = 5.0, kCoarse = 1.0;
  double best = unit + kLow, least = cost(best);
  for (double at = unit + kLow + kCoarse; at <= unit + kHigh; at += kCoarse) {
    const double value = cost(at);
    if (value < least) {
      least = value;
      best = at;
    }
  }
  double low = best - kCoarse, high = best + kCoarse;
  constexpr double kGolden = 1.0 / std::numbers::phi;
  double a = high - kGolden * (high - low), b = low + kGolden * (high - low);
  double fa = cost(a), fb = cost(b);
  while (high - low > 0.05) {
    if (fa < fb) {
      high = b;
      b = a;
      fb = fa;
      fa = cost(a = high - kGolden * (high - low));
    } else {
      low = a;
      a = b;
      fa = fb;
      fb = cost(b = low + kGolden * (high - low));
    }
  }
  return std::exp(0.5 * (low + high));
}

}  // namespace asperity
