#include "live_heading.h"

#include <algorithm>
#include <cmath>

namespace asperity {

namespace {

constexpr std::int64_t kStep_ns = 2'000'000;  // between the points that are kept
constexpr double kUsual_s = 2.0;              // over which the usual speed is taken

}  // namespace

LiveHeading::LiveHeading(double span_s, double rest_speed_mps, double rest_fraction)
    : span_s_(span_s), rest_speed_mps_(rest_speed_mps), rest_fraction_(rest_fraction) {}

void LiveHeading::forget_path() { behind_.clear(); }

Eigen::Vector3d LiveHeading::push(std::int64_t t_ns, const Eigen::Vector3d& p_m, const Eigen::Vector3d& ahead_m,
                                  const Eigen::Vector3d& normal) {
  const double step_s = behind_.empty() ? 0.0 : std::max(0.0, static_cast<double>(t_ns - last_ns_) * 1e-9);
  last_ns_ = t_ns;
  if (behind_.empty() || t_ns - behind_.back().t_ns >= kStep_ns) behind_.push_back({t_ns, p_m});
  const std::int64_t reach_ns = t_ns - std::llround(0.5 * span_s_ * 1e9);
  while (behind_.size() > 1 && behind_[1].t_ns <= reach_ns) behind_.pop_front();
  const double before_s = static_cast<double>(t_ns - behind_.front().t_ns) * 1e-9;
  Eigen::Vector3d way = ahead_m + (p_m - behind_.front().p_m);
  way -= way.dot(normal) * normal;
  speed_mps_ = way.norm() / (0.5 * span_s_ + before_s);
  if (speed_mps_ > std::max(rest_speed_mps_, rest_fraction_ * usual_mps_)) {
    direction_ = way.normalized();
    usual_mps_ += (1.0 - std::exp(-step_s / kUsual_s)) * (speed_mps_ - usual_mps_);
  } else {
    direction_ -= direction_.dot(normal) * normal;
    if (direction_.norm() > 0.0) direction_.normalize();
  }
  return direction_;
}

}  // namespace asperity
