#include "asperity/recorder/gravity_estimator.h"

#include <algorithm>
#include <cmath>

#include "asperity/base/units.h"

namespace asperity {

namespace {

constexpr std::int64_t kFewestSamples = 20;
constexpr std::int64_t kFewestPoses = 4;
constexpr std::size_t kMostOpenWindows = 8;

std::int64_t floor_div(std::int64_t a, std::int64_t b) { return a / b - (a % b < 0 ? 1 : 0); }

}  // namespace

void GravityEstimator::Moments::add(const Eigen::Vector3d& value) {
  ++count;
  const Eigen::Vector3d off = value - mean;
  mean += off / static_cast<double>(count);
  square += off.cwiseProduct(value - mean);
}

Eigen::Vector3d GravityEstimator::Moments::deviation() const {
  if (count < 2) return Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  return (square / static_cast<double>(count - 1)).cwiseMax(0.0).cwiseSqrt();
}

GravityEstimator::GravityEstimator(const RestConfig& config, const Calibration& calibration)
    : config_(config),
      accelerometer_(calibration.accelerometer),
      position_limit_m_(
          (3.0 * calibration.tracker.sigma_position_m).cwiseMax(Eigen::Vector3d::Constant(config.position_m))),
      window_ns_(static_cast<std::int64_t>(std::llround(config.window_s / kNanosecond_s))),
      latency_ns_(static_cast<std::int64_t>(std::llround(calibration.tracker.latency_s / kNanosecond_s))) {}

GravityEstimator::Window* GravityEstimator::window_at(std::int64_t t_ns) {
  const std::int64_t index = floor_div(t_ns, window_ns_);
  if (index < closed_before_) return nullptr;
  const auto place = std::lower_bound(open_.begin(), open_.end(), index,
                                      [](const Window& window, std::int64_t i) { return window.index < i; });
  if (place != open_.end() && place->index == index) return &*place;
  Window fresh;
  fresh.index = index;
  open_.insert(place, fresh);
  // One stream may be behind the other by some windows, and no more.
  while (open_.size() > kMostOpenWindows) {
    judge(open_.front());
    closed_before_ = open_.front().index + 1;
    open_.pop_front();
  }
  if (index < closed_before_) return nullptr;
  return &*std::lower_bound(open_.begin(), open_.end(), index,
                            [](const Window& window, std::int64_t i) { return window.index < i; });
}

void GravityEstimator::add_probe(std::int64_t t_ns, const Eigen::Vector3d& accel_counts) {
  if (!accelerometer_.rotation_known || !accel_counts.allFinite()) return;
  if (Window* window = window_at(t_ns)) window->specific_force.add(accelerometer_.specific_force_mps2(accel_counts));
}

void GravityEstimator::add_pose(std::int64_t t_ns, const Pose& T_world_marker) {
  if (!accelerometer_.rotation_known) return;
  Window* window = window_at(t_ns - latency_ns_);
  if (window == nullptr) return;
  if (window->position.count == 0) window->first_rotation = T_world_marker.rotation;
  window->position.add(T_world_marker.translation_m);
  window->turn.add(log_rotation(T_world_marker.rotation * window->first_rotation.conjugate()));
}

void GravityEstimator::judge(const Window& window) {
  if (window.specific_force.count < kFewestSamples || window.position.count < kFewestPoses) return;
  if (!(window.specific_force.deviation().maxCoeff() <= config_.acceleration_mps2)) return;
  if (!(window.position.deviation().array() <= position_limit_m_.array()).all()) return;
  if (!(window.turn.deviation().maxCoeff() <= config_.rotation_rad)) return;
  // The mean of small turns is the mean rotation to second order in their size.
  const Eigen::Quaterniond R_world_marker = exp_rotation(window.turn.mean) * window.first_rotation;
  gravity_.add(-(R_world_marker * window.specific_force.mean));
}

void GravityEstimator::finish() {
  for (const Window& window : open_) judge(window);
  open_.clear();
  closed_before_ = std::numeric_limits<std::int64_t>::max();
}

GravityEstimate GravityEstimator::estimate() const {
  GravityEstimate out;
  out.windows = gravity_.count;
  if (gravity_.count == 0) return out;
  out.gravity_world_mps2 = gravity_.mean;
  out.scatter_mps2 = gravity_.deviation();
  const double share = gravity_.mean.norm() / kStandardGravity_mps2;
  out.implausible = !(std::abs(share - 1.0) <= config_.magnitude_tolerance);
  out.measured = !out.implausible;
  return out;
}

}  // namespace asperity
