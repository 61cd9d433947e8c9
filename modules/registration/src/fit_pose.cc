#include "fit_pose.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Cholesky>

namespace asperity::registration {
namespace {

// Relative to the points' radius: steps below it are rounding.
constexpr double kRounding = 1e-14;
// A share of the isotropic metric that always stays, so that undetermined motions get no step.
constexpr double kDamping = 1e-9;
constexpr int kStallLimit = 3;

struct Sums {
  Matrix6 hessian = Matrix6::Zero();  // upper triangle while summing
  Vector6 gradient = Vector6::Zero();
  double weight = 0.0;
  std::size_t usable = 0;
};

Vector6 jacobian(const Match& m, const Eigen::Vector3d& centre_m) {
  Vector6 j;
  j.head<3>() = (m.y_m - centre_m).cross(m.n);
  j.tail<3>() = m.n;
  return j;
}

// The plane's Hessian and gradient; the isotropic part is added from the weights' sum and the points' metric.
Sums accumulate_sums(const Matcher& matcher, const CentredPose& pose, double width_m) {
  Sums out;
  double h[6][6] = {};
  double g[6] = {};
  const double inverse = 1.0 / (width_m * width_m);
  for (const Match& m : matcher.matches()) {
    if (!m.usable) continue;
    ++out.usable;
    const double w = std::exp(-m.distance_m * m.distance_m * inverse);
    const Vector6 j = jacobian(m, pose.centre_m);
    out.weight += w;
    for (int r = 0; r < 6; ++r) {
      const double wj = w * j(r);
      g[r] += wj * m.distance_m;
      for (int c = r; c < 6; ++c) h[r][c] += wj * j(c);
    }
  }
  for (int r = 0; r < 6; ++r) {
    out.gradient(r) = g[r];
    for (int c = r; c < 6; ++c) out.hessian(r, c) = out.hessian(c, r) = h[r][c];
  }
  return out;
}

// Of the motion from the guess; `metric` gives its mean square over the points.
Matrix6 guess_precision(const FitOptions& options, const Matrix6& metric) {
  Matrix6 out = Matrix6::Zero();
  if (options.guess_sigma_m > 0.0) out += options.alike / (options.guess_sigma_m * options.guess_sigma_m) * metric;
  if (options.guess_sigma_rad > 0.0) {
    out.topLeftCorner<3, 3>().diagonal().array() += options.alike / (options.guess_sigma_rad * options.guess_sigma_rad);
  }
  return out;
}

}  // namespace

double robust_cost_m2(const Matcher& matcher, double width_m) {
  double sum = 0.0;
  const double inverse = 1.0 / (width_m * width_m);
  for (const Match& m : matcher.matches()) {
    sum += m.usable ? -std::expm1(-m.distance_m * m.distance_m * inverse) : 1.0;
  }
  return width_m * width_m * sum / static_cast<double>(matcher.size());
}

Matrix6 information(const Matcher& matcher, const CentredPose& pose, double limit_m) {
  Matrix6 out = Matrix6::Zero();
  for (const Match& m : matcher.matches()) {
    if (!m.usable || std::abs(m.distance_m) > limit_m) continue;
    const Vector6 j = jacobian(m, pose.centre_m);
    out += j * j.transpose();
  }
  return out;
}

Fit fit_pose(Matcher& matcher, const PointSet& points, const CentredPose& start, const FitOptions& options) {
  Fit best;
  best.pose = start;
  const double n = static_cast<double>(matcher.size());
  const double rounding_m = kRounding * points.radius_m;
  const Matrix6 metric = motion_metric(points, start);
  CentredPose pose = start;
  double isotropic = options.isotropic;
  double scale_m = std::max(options.fixed_scale_m, options.known_scale_m);
  bool settled = options.fixed_scale_m > 0.0;
  bool have_best = false;
  int stalled = 0;
  double last_sigmas = 0.0;

  for (int k = 0; k < options.max_iterations; ++k) {
    if (options.watch != nullptr) options.watch->check();
    matcher.match(pose);
    if (!settled) {
      const double now_m = std::max(matcher.scale_m(), rounding_m);
      // The scale is frozen once it no longer falls: from then on costs can be compared.
      settled = now_m > 0.9 * scale_m && scale_m > 0.0 && isotropic < 0.05;
      if (!settled || now_m < scale_m || scale_m == 0.0) scale_m = now_m;
    }
    const double width_m = options.robust_sigmas * scale_m;
    if (options.watch != nullptr) options.watch->report(matcher, points, pose, width_m);
    const Sums sums = accumulate_sums(matcher, pose, width_m);
    best.iterations = k + 1;
    if (sums.usable < 3 || !(sums.weight > 0.0)) {
      best.enough = have_best;
      best.scale_m = scale_m;
      best.cost_m2 = width_m * width_m;
      return best;
    }
    const double cost_m2 = robust_cost_m2(matcher, width_m);
    if (!settled || !have_best || cost_m2 < best.cost_m2) {
      stalled = 0;
      best.pose = pose;
      best.cost_m2 = cost_m2;
      best.scale_m = scale_m;
      have_best = true;
    } else if (++stalled >= kStallLimit) {
      best.stopped_by = StopRule::kStalled;
      return best;
    }

    Matrix6 hessian = (1.0 - isotropic) * sums.hessian + (isotropic + kDamping) * sums.weight * metric;
    Vector6 gradient = sums.gradient;
    const Vector6 from_guess = motion_between(options.reference, pose);
    const Matrix6 prior = guess_precision(options, metric) * scale_m * scale_m;
    hessian += prior;
    gradient += prior * from_guess;
    for (const Hold& hold : options.holds) {
      constexpr double kStiff = 1e6;
      hessian += kStiff * n * hold.row * hold.row.transpose();
      gradient += kStiff * n * (hold.row.dot(from_guess) - hold.target) * hold.row;
    }
    const Vector6 step = -hessian.ldlt().solve(gradient);
    if (!step.allFinite()) return best;
    const CentredPose before = pose;
    pose = moved(pose, step);

    const double step_m2 = step.dot(metric * step);
    const double sigmas = std::sqrt(step.dot(sums.hessian * step)) / scale_m;
    const bool annealed = isotropic < 0.05;
    // Steps that shrink by the ratio r have r / (1 - r) of the last one still to go.
    const double ratio = last_sigmas > 0.0 ? sigmas / last_sigmas : 1.0;
    const double to_go = ratio < 1.0 ? sigmas * ratio / (1.0 - ratio) : std::numeric_limits<double>::infinity();
    const bool small =
        sigmas < 0.1 * options.step_sigmas || (sigmas < options.step_sigmas && to_go < 0.3 * options.step_sigmas);
    last_sigmas = settled ? sigmas : 0.0;
    isotropic *= options.isotropic_decay;
    if (step_m2 <= rounding_m * rounding_m || (annealed && settled && small)) {
      best.pose = pose;
      best.matched = true;
      matcher.advance(step, before.centre_m);
      best.stopped_by = StopRule::kPoseChange;
      return best;
    }
  }
  return best;
}

}  // namespace asperity::registration
