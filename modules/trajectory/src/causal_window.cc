#include "causal_window.h"

#include <algorithm>

#include "fused_problem.h"

namespace asperity::inertial_smoother {

Problem make_window(const InertialStream& inertial, const FusedConfig& config, double begin_s,
                    std::span<const double> pose_s, std::span<const Pose> T_world_marker, bool first_pose_counts) {
  const std::int64_t origin_ns = inertial.t_ns.front();
  const auto time_of = [&](std::size_t i) { return static_cast<double>(inertial.t_ns[i] - origin_ns) * 1e-9; };
  const std::size_t n = inertial.size();
  Problem out;
  out.poses.assign(T_world_marker.begin(), T_world_marker.end());
  out.position_weight.assign(pose_s.size(), 1.0);
  out.rotation_weight.assign(pose_s.size(), 1.0);

  std::size_t next = 0;
  while (next < n && time_of(next) < begin_s) ++next;
  std::size_t pose = 0;
  while (pose < pose_s.size() && (pose_s[pose] < begin_s || (pose_s[pose] == begin_s && !first_pose_counts))) ++pose;

  const auto sample_knot = [&](std::size_t i) {
    Knot knot = at_sample(inertial, i, origin_ns);
    if (i + 1 < n) set_noise(inertial, config, i, knot);
    return knot;
  };
  const auto add_epoch = [&](std::int64_t index) { out.epochs.push_back({out.knots.size() - 1, index}); };
  const auto add_knot_at = [&](double t_s) {
    if (next < n && time_of(next) == t_s) {
      out.knots.push_back(sample_knot(next++));
    } else {
      out.knots.push_back(between_samples(inertial, config, std::clamp<std::size_t>(next, 1, n - 1), t_s, origin_ns));
    }
  };
  const bool measured = pose < pose_s.size() && pose_s[pose] == begin_s;
  add_knot_at(begin_s);
  add_epoch(measured ? static_cast<std::int64_t>(pose++) : -1);
  double last_epoch_s = begin_s;
  while (next < n) {
    if (pose < pose_s.size() && pose_s[pose] <= time_of(next)) {
      add_knot_at(pose_s[pose]);
      add_epoch(static_cast<std::int64_t>(pose++));
      last_epoch_s = out.knots.back().t;
      continue;
    }
    out.knots.push_back(sample_knot(next++));
    if (out.knots.back().t - last_epoch_s > kLongestInterval_s || next == n) {
      add_epoch(-1);
      last_epoch_s = out.knots.back().t;
    }
  }
  return out;
}

}  // namespace asperity::inertial_smoother
