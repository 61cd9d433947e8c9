#include "asperity/trajectory/estimate_trajectory_tuned.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <Eigen/LU>

#include "asperity/base/units.h"
#include "fused_setup.h"
#include "tip_noise.h"

namespace asperity {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kLargestShare_chi2 = 16.8;
constexpr double kFirstVelocity_mps = 0.1;  // as the thesis's

// One axis: position and velocity, and their covariance. F couples no axes.
struct Axis {
  Vector2d x = Vector2d::Zero();
  Matrix2d P = Matrix2d::Zero();

  static Matrix2d transition(double dt) { return Matrix2d{{1.0, dt}, {0.0, 1.0}}; }

  void predict(double dt, double psd) {
    const Matrix2d F = transition(dt);
    x = F * x;
    P = F * P * F.transpose();
    P += psd * Matrix2d{{dt * dt * dt / 3.0, dt * dt / 2.0}, {dt * dt / 2.0, dt}};
  }

  // −½ log |S|; the squared innovation over its variance is added to `d2`.
  double update(double measured_m, double R_m2, double& d2) {
    const double S = P(0, 0) + R_m2;
    const double y = measured_m - x[0];
    const Vector2d gain = P.col(0) / S;
    x += gain * y;
    P -= (gain * P.row(0)).eval();
    d2 += y * y / S;
    return -0.5 * std::log(S);
  }

  // The state here, given what the next pose, `dt` later, changed of the prediction `before` into `after`.
  void look_back(double dt, const Axis& before, const Axis& after) {
    const Matrix2d C = P * transition(dt).transpose() * before.P.inverse();
    x += C * (after.x - before.x);
    P += C * (after.P - before.P) * C.transpose();
  }
};

struct Filter {
  std::array<Axis, 3> axes;

  Filter(const Vector3d& start_m, const Vector3d& R_m2) {
    for (int i = 0; i < 3; ++i) {
      Axis& axis = axes[static_cast<std::size_t>(i)];
      axis.x[0] = start_m[i];
      axis.P(0, 0) = R_m2[i];
      axis.P(1, 1) = kFirstVelocity_mps * kFirstVelocity_mps;
    }
  }

  void predict(double dt, double psd) {
    for (Axis& axis : axes) axis.predict(dt, psd);
  }

  // The pose's share of the log-likelihood, without its constant.
  double update(const Vector3d& measured_m, const Vector3d& R_m2) {
    double sum = 0.0, d2 = 0.0;
    for (int i = 0; i < 3; ++i) sum += axes[static_cast<std::size_t>(i)].update(measured_m[i], R_m2[i], d2);
    return sum - 0.5 * std::min(d2, kLargestShare_chi2);
  }
};

}  // namespace

double white_acceleration_likelihood(std::span<const std::int64_t> t_ns, std::span<const Vector3d> measured_m,
                                     const Vector3d& R_m2, double accel_psd) {
  if (measured_m.empty()) return 0.0;
  Filter filter(measured_m.front(), R_m2);
  double sum = 0.0;
  for (std::size_t i = 1; i < measured_m.size(); ++i) {
    filter.predict(in_seconds(t_ns[i] - t_ns[i - 1]), accel_psd);
    sum += filter.update(measured_m[i], R_m2);
  }
  return sum;
}

double likeliest_white_acceleration(std::span<const std::int64_t> t_ns, std::span<const Vector3d> measured_m,
                                    const Vector3d& R_m2) {
  const auto at = [&](double decade) {
    return white_acceleration_likelihood(t_ns, measured_m, R_m2, std::pow(10.0, decade));
  };
  constexpr double kLow = -8.0, kHigh = 6.0;
  double best = kLow;
  double best_likelihood = at(best);
  for (double decade = kLow + 1.0; decade <= kHigh; decade += 1.0) {
    const double likelihood = at(decade);
    if (likelihood > best_likelihood) best = decade, best_likelihood = likelihood;
  }
  // Golden section between the neighbours.
  const double ratio = 0.5 * (std::sqrt(5.0) - 1.0);
  double low = std::max(kLow, best - 1.0), high = std::min(kHigh, best + 1.0);
  double a = high - ratio * (high - low), b = low + ratio * (high - low);
  double at_a = at(a), at_b = at(b);
  while (high - low > 0.0086) {  // 2 %
    if (at_a > at_b) {
      high = b, b = a, at_b = at_a;
      a = high - ratio * (high - low), at_a = at(a);
    } else {
      low = a, a = b, at_a = at_b;
      b = low + ratio * (high - low), at_b = at(b);
    }
  }
  return std::pow(10.0, 0.5 * (low + high));
}

TrajectoryResult estimate_trajectory_tuned(const Recording& recording, const ThesisTrajectoryConfig& config) {
  TrajectoryResult result = estimate_trajectory_thesis(recording, config);
  TipMotion& motion = result.motion;
  const Calibration& calibration = recording.calibration;
  const std::int64_t latency_ns = std::llround(calibration.tracker.latency_s / kNanosecond_s);
  std::vector<std::int64_t> t_ns;
  std::vector<Vector3d> tip_m;
  std::vector<Eigen::Quaterniond> q_world_marker;
  for (std::size_t i = 0; i < recording.tracker.size(); ++i) {
    const Pose& pose = recording.tracker.T_world_marker[i];
    t_ns.push_back(recording.tracker.t_ns[i] - latency_ns);
    tip_m.push_back(pose * calibration.tip_in_marker_m);
    q_world_marker.push_back(pose.rotation);
  }
  const Vector3d R_m2 = mean_tip_variance_m2(calibration.tracker, q_world_marker, calibration.tip_in_marker_m);
  const double latency2_s2 = std::pow(calibration.tracker.latency_sigma_s, 2);
  const double psd = likeliest_white_acceleration(t_ns, tip_m, R_m2);

  // From pose to pose; the samples between from the first, corrected by what the second changes.
  Filter filter(tip_m.front(), R_m2);
  motion.cov_world_tip_m2.assign(motion.size(), Eigen::Matrix3d::Zero());
  std::size_t sample = 0;
  for (std::size_t k = 0; k + 1 < t_ns.size(); ++k) {
    Filter before = filter;
    before.predict(in_seconds(t_ns[k + 1] - t_ns[k]), psd);
    Filter after = before;
    after.update(tip_m[k + 1], R_m2);
    const bool last = k + 2 == t_ns.size();
    for (; sample < motion.size() && (last || motion.t_ns[sample] <= t_ns[k + 1]); ++sample) {
      Filter now = filter;
      now.predict(in_seconds(std::max<std::int64_t>(0, motion.t_ns[sample] - t_ns[k])), psd);
      Vector3d variance_m2;
      for (int i = 0; i < 3; ++i) {
        const auto axis = static_cast<std::size_t>(i);
        now.axes[axis].look_back(in_seconds(t_ns[k + 1] - motion.t_ns[sample]), before.axes[axis], after.axes[axis]);
        motion.p_world_tip_m[sample][i] = now.axes[axis].x[0];
        motion.v_world_tip_mps[sample][i] = now.axes[axis].x[1];
        variance_m2[i] = now.axes[axis].P(0, 0);
      }
      const Vector3d& v = motion.v_world_tip_mps[sample];
      Eigen::Matrix3d covariance_m2 = variance_m2.asDiagonal();
      covariance_m2 += latency2_s2 * v * v.transpose();
      covariance_m2 += tip_place_covariance_m2(calibration, motion.q_world_marker[sample]);
      motion.cov_world_tip_m2.set(sample, covariance_m2);
    }
    filter = after;
  }
  motion.sigma_tip_in_marker_m = inertial_smoother::tip_sigma_m(calibration, FusedConfig{});
  result.metrics["white_acceleration_psd"] = psd;
  return result;
}

}  // namespace asperity
