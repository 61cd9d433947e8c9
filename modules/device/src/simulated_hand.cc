#include "simulated_hand.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "asperity/base/error.h"
#include "asperity/base/units.h"
#include "check_config.h"
#include "check_samples.h"
#include "matrix_exponential.h"
#include "unit_vector.h"

namespace asperity {

SimulatedHand::SimulatedHand(const HandModelConfig& config, HandPath path) : config_(config), path_(std::move(path)) {
  check_config("hand", config_);
  check_samples(path_, "the hand's path");
  for (const HandPoint& point : path_) {
    if (!std::isfinite(point.press_N)) throw Error("the hand's path: a pressing force is not finite");
  }
  n_ = unit_vector(config_.press_direction, "hand.press_direction");
  t_ns_ = start_ns();
  p_m_ = path_.front().p_m;
  enter_segment(0);
}

void SimulatedHand::enter_segment(std::size_t segment) noexcept {
  segment_ = segment;
  slope_mps_.setZero();
  press_slope_N_per_s_ = 0.0;
  if (segment + 1 >= path_.size()) return;
  const HandPoint& from = path_[segment];
  const HandPoint& to = path_[segment + 1];
  const double duration_s = static_cast<double>(to.t_ns - from.t_ns) * kNanosecond_s;
  slope_mps_ = (to.p_m - from.p_m) / duration_s;
  press_slope_N_per_s_ = (to.press_N - from.press_N) / duration_s;
}

SimulatedHand::Step SimulatedHand::step_of(std::int64_t dt_ns) const noexcept {
  const double dt_s = static_cast<double>(dt_ns) * kNanosecond_s;
  AcrossMatrix across = AcrossMatrix::Zero();
  across(0, 1) = 1.0;
  across.row(1) << -config_.across_stiffness_N_per_m, -config_.across_damping_N_s_per_m, 1.0;
  across.row(1) /= config_.across_mass_kg;

  AlongMatrix along = AlongMatrix::Zero();
  along(0, 1) = 1.0;
  along.row(1) << -config_.press_stiffness_N_per_m, -config_.press_damping_N_s_per_m, config_.press_stiffness_N_per_m,
      1.0, 0.0;
  along.row(1) /= config_.press_mass_kg;
  if (config_.press_adaptation_s > 0.0) {
    along(2, 0) = 1.0 / config_.press_adaptation_s;
    along(2, 2) = -along(2, 0);
  }
  along(3, 4) = 1.0;

  Step step;
  step.dt_ns = dt_ns;
  step.across = matrix_exponential<3>(dt_s * across);
  step.along = matrix_exponential<5>(dt_s * along);
  return step;
}

void SimulatedHand::move(std::int64_t to_ns, const Step& step, const Eigen::Vector3d& force_N) noexcept {
  const HandPoint& knot = path_[segment_];
  const double from_s = static_cast<double>(t_ns_ - knot.t_ns) * kNanosecond_s;
  const double to_s = static_cast<double>(to_ns - knot.t_ns) * kNanosecond_s;
  const Eigen::Vector3d e_m = p_m_ - (knot.p_m + from_s * slope_mps_);
  const Eigen::Vector3d ev_mps = v_mps_ - slope_mps_;

  const double e_n = n_.dot(e_m);
  const double ev_n = n_.dot(ev_mps);
  const double f_n = n_.dot(force_N);
  const Eigen::Vector3d e_t = e_m - e_n * n_;
  const Eigen::Vector3d ev_t = ev_mps - ev_n * n_;
  const Eigen::Vector3d f_t = force_N - f_n * n_;

  Eigen::Matrix<double, 5, 1> x;
  const double press_N = knot.press_N + from_s * press_slope_N_per_s_;
  x << e_n, ev_n, yield_m_, press_N + f_n, press_slope_N_per_s_;
  const Eigen::Matrix<double, 5, 1> y = step.along.lazyProduct(x);
  const AcrossMatrix& a = step.across;
  p_m_ = knot.p_m + to_s * slope_mps_ + y[0] * n_ + a(0, 0) * e_t + a(0, 1) * ev_t + a(0, 2) * f_t;
  v_mps_ = slope_mps_ + y[1] * n_ + a(1, 0) * e_t + a(1, 1) * ev_t + a(1, 2) * f_t;
  yield_m_ = std::clamp(y[2], -config_.reach_m, config_.reach_m);
  t_ns_ = to_ns;
}

void SimulatedHand::advance(std::int64_t t_ns, const Eigen::Vector3d& force_N) noexcept {
  while (t_ns_ < t_ns) {
    const bool last = segment_ + 1 >= path_.size();
    const std::int64_t knot_ns = last ? t_ns : path_[segment_ + 1].t_ns;
    const std::int64_t to_ns = std::min(t_ns, knot_ns);
    const std::int64_t dt_ns = to_ns - t_ns_;
    if (to_ns == t_ns) {
      if (dt_ns != usual_.dt_ns) usual_ = step_of(dt_ns);
      move(to_ns, usual_, force_N);
    } else {
      move(to_ns, step_of(dt_ns), force_N);
    }
    if (!last && to_ns == knot_ns) enter_segment(segment_ + 1);
  }
}

}  // namespace asperity
