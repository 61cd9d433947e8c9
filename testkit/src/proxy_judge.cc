#include "asperity/testkit/proxy_judge.h"

#include <algorithm>
#include <cmath>

namespace asperity::testkit {
namespace {

using Eigen::Vector3d;

constexpr double kStuck = 1.5;       // of the depth
constexpr double kThrough = 2e-5;    // of the distance from the middle: 1 um at 50 mm, 1 mN at 1 N/mm
constexpr double kSamePlace = 2e-5;  // of the distance from the middle
constexpr double kFrozen = 1e-3;     // of the true minimum's step
constexpr double kMoving =
    0.5;  // of the device's step: below it the true minimum is near rest, as it is in a corner's hollow

}  // namespace

ProxyJudge::ProxyJudge(const TriangleMesh& mesh, const MeshBvh& bvh, const ProxyJudgeConfig& config)
    : bvh_(bvh),
      config_(config),
      point_(mesh),
      local_point_(mesh),
      ball_(mesh, bvh, config.tip_radius_m),
      local_ball_(mesh, bvh, config.tip_radius_m) {}

double ProxyJudge::inside_m(const Vector3d& centre_m) {
  const double distance_m = centre_m.norm();
  const Vector3d direction = centre_m / distance_m;
  const double surface_m = 2.0 * distance_m - bvh_.cast_ray(2.0 * distance_m * direction, -direction).t;
  if (config_.tip_radius_m <= 0.0) return surface_m - distance_m;
  const double gap_m = bvh_.closest_point(centre_m).distance_m;
  return config_.tip_radius_m - (distance_m < surface_m ? -gap_m : gap_m);
}

Vector3d ProxyJudge::minimum_from(const Vector3d& centre_m, const Vector3d& device_m) {
  if (config_.tip_radius_m > 0.0) return local_ball_.descend(centre_m, device_m);
  local_point_.start(bvh_.closest_point(centre_m).triangle, centre_m);
  return local_point_.follow(device_m, 1).p_m;
}

void ProxyJudge::tick(const Vector3d& device_m, const Vector3d& proxy_m) {
  ProxyStatistics& f = sums_;
  const bool pressed = inside_m(device_m) > 0.0;
  const double lag_m = (proxy_m - device_m).norm();
  f.largest_lag_m = std::max(f.largest_lag_m, lag_m);
  const bool stuck = !(lag_m <= kStuck * config_.depth_m);
  f.stuck_events += stuck && !was_stuck_;
  f.stuck_ticks += stuck;
  const double proxy_inside_m = inside_m(proxy_m);
  f.deepest_proxy_m = std::max(f.deepest_proxy_m, proxy_inside_m);
  const bool through = !(proxy_inside_m <= kThrough * proxy_m.norm());
  f.pop_throughs += through && !was_through_;

  last_error_m_ = last_step_excess_m_ = 0.0;
  bool other = false;
  if (config_.minimum) {
    const Vector3d before_m = true_m_;
    if (!pressed) {
      true_m_ = device_m;
      ball_.start(device_m);
    } else if (config_.tip_radius_m > 0.0) {
      if (f.ticks == 0) ball_.start(proxy_m);
      true_m_ = ball_.follow(device_m);
    } else {
      if (!was_pressed_) point_.start(bvh_.closest_point(device_m).triangle, device_m);
      true_m_ = point_.follow(device_m).p_m;
    }
    last_error_m_ = (proxy_m - true_m_).norm();
    double local_m = last_error_m_;
    if (pressed && last_error_m_ > kSamePlace * proxy_m.norm()) {
      const Vector3d own_m = minimum_from(proxy_m, device_m);
      other = (own_m - true_m_).norm() > kSamePlace * proxy_m.norm();
      local_m = (own_m - proxy_m).norm();
    }
    f.other_basin += other;
    f.rms_error_m += last_error_m_ * last_error_m_;
    f.largest_error_m = std::max(f.largest_error_m, last_error_m_);
    f.rms_local_m += local_m * local_m;
    f.largest_local_m = std::max(f.largest_local_m, local_m);
    f.largest_true_lag_m = std::max(f.largest_true_lag_m, (true_m_ - device_m).norm());
    if (f.ticks > 0 && pressed && was_pressed_) {
      const double true_step_m = (true_m_ - before_m).norm(), step_m = (proxy_m - proxy_m_).norm();
      if (!other && !was_other_) last_step_excess_m_ = step_m - true_step_m;
      f.largest_step_excess_m = std::max(f.largest_step_excess_m, last_step_excess_m_);
      const bool moving = true_step_m > kMoving * (device_m - device_m_).norm();
      f.frozen_ticks += moving && step_m < kFrozen * true_step_m;
    }
  }
  ++f.ticks;
  f.pressed += pressed;
  device_m_ = device_m;
  proxy_m_ = proxy_m;
  was_pressed_ = pressed;
  was_stuck_ = stuck;
  was_through_ = through;
  was_other_ = other;
}

ProxyStatistics ProxyJudge::statistics() const {
  ProxyStatistics out = sums_;
  const double count = static_cast<double>(std::max<std::size_t>(out.pressed, 1));
  out.rms_error_m = std::sqrt(sums_.rms_error_m / count);
  out.rms_local_m = std::sqrt(sums_.rms_local_m / count);
  return out;
}

}  // namespace asperity::testkit
