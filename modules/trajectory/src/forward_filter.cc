#include "forward_filter.h"

#include <algorithm>
#include <cmath>

#include "fused_setup.h"
#include "inertial_model.h"

namespace asperity::inertial_smoother {

namespace {

Problem without_time_line(const Problem& window) {
  Problem out = window;
  out.knots.clear();
  out.epochs.clear();
  return out;
}

}  // namespace

StepFilter::StepFilter(const Problem& window) : settings(without_time_line(window)), window_(window) {}

Checkpoint StepFilter::predict(std::size_t e, const Checkpoint& from) {
  settings.knots.clear();
  settings.knots.append(window_.knots, window_.epochs[e - 1].knot, window_.epochs[e].knot + 1);
  settings.epochs = {{0, -1}, {settings.knots.size() - 1, -1}};
  settings.start = from.x;
  settings.start_covariance = from.P;
  settings.refused_in_a_row = from.refused_in_a_row;
  return filter_motion(settings).checkpoint;
}

Filtered StepFilter::update(std::size_t e, const Checkpoint& before) {
  settings.knots.clear();
  settings.knots.push_back(window_.knots[window_.epochs[e].knot]);
  settings.epochs = {{0, window_.epochs[e].pose}};
  settings.start = before.x;
  settings.start_covariance = before.P;
  settings.refused_in_a_row = before.refused_in_a_row;
  return filter_motion(settings);
}

Matrix3d tip_covariance(const Checkpoint& at, const Problem& problem, const Vector3d& tip_in_marker_m) {
  const Layout& layout = problem.layout;
  const Matrix3d R = at.x.q.toRotationMatrix();
  Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, kMax> J =
      Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, kMax>::Zero(3, layout.size);
  J.block<3, 3>(0, kP).setIdentity();
  J.block<3, 3>(0, kPhi) = -skew(R * (tip_in_marker_m - at.x.lever));
  if (layout.lever >= 0) J.block<3, 3>(0, layout.lever) = -R;
  return J * at.P * J.transpose() + R * problem.tip_sigma_m.cwiseAbs2().asDiagonal() * R.transpose();
}

std::vector<PointState> dead_reckon(const Problem& window, std::size_t e, const Nominal& begin,
                                    const Vector3d& tip_in_marker_m) {
  std::vector<PointState> out;
  Nominal x = begin;
  const Mounting mounting = mounting_of(x, window);
  for (std::size_t k = window.epochs[e - 1].knot; k < window.epochs[e].knot; ++k) {
    const Knot knot = window.knots[k + 1];
    advance_state(x, window.knots[k], knot, mounting, {});
    if (knot.sample < 0) continue;
    PointState& state = out.emplace_back();
    state.p_m = x.p;
    state.v_mps = x.v;
    state.a_mps2 = x.q * (mounting.accel * knot.f - x.ba) + mounting.gravity;
    state.omega_radps = x.q * (mounting.gyro * knot.w - x.bg);
    state.arm_m = x.q * (tip_in_marker_m - x.lever);
    state.q_world_marker = x.q;
  }
  return out;
}

void CausalMotion::append(const CausalFeed& feed, std::size_t e, const std::vector<PointState>& states,
                          const Matrix3d& begin_m2, const Matrix3d& end_m2, const std::vector<Matrix3d>& spread_m2,
                          double latency_s) {
  constexpr double kReach_s = 4e-3;  // a shorter difference is only the gyroscope's noise
  const Problem& window = feed.problem();
  motion.sigma_tip_in_marker_m = window.tip_sigma_m;
  // What the estimate adds to the prior moves the probe's latency by its share of the prior variance.
  const double sigma_s = latency_sigma_s(calibration_);
  const double share = sigma_s > 0.0 ? std::pow(calibration_.probe_latency_sigma_s / sigma_s, 2) : 0.0;
  const std::int64_t latency_ns = std::llround((calibration_.probe_latency_s - share * latency_s) * 1e9);
  const double t0 = window.knots[window.epochs[e - 1].knot].t;
  const double T = window.knots[window.epochs[e].knot].t - t0;
  std::size_t i = 0;
  for (std::size_t k = window.epochs[e - 1].knot + 1; k <= window.epochs[e].knot; ++k) {
    const Knot knot = window.knots[k];
    if (knot.sample < 0) continue;
    const PointState& state = states[i++];
    const double t_s = static_cast<double>(feed.origin_ns()) * 1e-9 + knot.t;
    rates_.emplace_back(t_s, state.omega_radps);
    while (rates_.size() > 2 && rates_[1].first <= t_s - kReach_s) rates_.erase(rates_.begin());
    const auto sample = static_cast<std::size_t>(knot.sample);
    if (feed.first_row() + sample < next_row_) continue;  // in the block before already
    next_row_ = feed.first_row() + sample + 1;
    std::int64_t t_ns = feed.stream().t_ns[sample] - latency_ns;
    if (!motion.t_ns.empty()) t_ns = std::max(t_ns, motion.t_ns.back() + 1);
    const double reached_s = t_s - rates_.front().first;
    const Vector3d alpha = reached_s > 0.0 ? Vector3d((state.omega_radps - rates_.front().second) / reached_s)
                                           : Vector3d(Vector3d::Zero());
    const double part = T > 0.0 ? std::clamp((knot.t - t0) / T, 0.0, 1.0) : 1.0;
    const Vector3d& omega = state.omega_radps;
    motion.t_ns.push_back(t_ns);
    motion.p_world_tip_m.push_back(state.p_m + state.arm_m);
    motion.q_world_marker.push_back(state.q_world_marker);
    motion.v_world_tip_mps.push_back(state.v_mps + omega.cross(state.arm_m));
    motion.a_world_tip_mps2.push_back(state.a_mps2 + omega.cross(omega.cross(state.arm_m)) + alpha.cross(state.arm_m));
    Matrix3d cov = (1.0 - part) * begin_m2 + part * end_m2;
    if (!spread_m2.empty()) cov += spread_m2[i - 1];
    motion.cov_world_tip_m2.push_back(cov);
    motion.force_N.push_back(feed.stream().force_N[sample]);
    if (!feed.stream().force3_marker_N.empty())
      motion.force_world_N.push_back(state.q_world_marker * feed.stream().force3_marker_N[sample]);
  }
}

}  // namespace asperity::inertial_smoother
