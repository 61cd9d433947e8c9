#include "asperity/simulation/force_steps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "asperity/base/error.h"
#include "septic_step.h"

namespace asperity {

MotionFunction force_steps_motion(const ForceSteps& steps, const Pose& T_world_marker,
                                  const Eigen::Vector3d& tip_in_marker_m) {
  MotionState state;
  state.p_world_tip_m = T_world_marker * tip_in_marker_m;
  state.q_world_marker = T_world_marker.rotation;
  const Eigen::Vector3d axis_world = T_world_marker.rotation * -tip_in_marker_m.normalized();
  return [steps, state, axis_world](double t_s) {
    const double period_s = steps.hold_s + steps.move_s;
    const auto last = static_cast<double>(steps.force_N.size() - 1);
    const double index = std::clamp(std::floor(t_s / period_s), 0.0, last);
    const auto here = static_cast<std::size_t>(index);
    const std::size_t next = std::min(here + 1, steps.force_N.size() - 1);
    const double share = septic_step((t_s - index * period_s - steps.hold_s) / steps.move_s);
    MotionState out = state;
    out.normal_force_N = steps.force_N[here] + share * (steps.force_N[next] - steps.force_N[here]);
    out.contact_force_world_N = out.normal_force_N * axis_world;
    return out;
  };
}

ForceReadings read_force_steps(const ForceSteps& steps, const ProbeStream& probe, std::int64_t start_ns) {
  ForceReadings out;
  for (std::size_t step = 0; step < steps.force_N.size(); ++step) {
    const double begin_s = static_cast<double>(step) * (steps.hold_s + steps.move_s);
    const std::int64_t from_ns = start_ns + std::llround(1e9 * (begin_s + 0.25 * steps.hold_s));
    const std::int64_t to_ns = start_ns + std::llround(1e9 * (begin_s + 0.75 * steps.hold_s));
    double sum = 0.0;
    int count = 0;
    const auto first = std::lower_bound(probe.t_ns.begin(), probe.t_ns.end(), from_ns) - probe.t_ns.begin();
    for (auto i = static_cast<std::size_t>(first); i < probe.size() && probe.t_ns[i] < to_ns; ++i) {
      if (std::isnan(probe.force_counts[i])) continue;
      sum += probe.force_counts[i];
      ++count;
    }
    if (count == 0) throw Error(fmt::format("no sample of the force came during step {}", step + 1));
    out.counts.push_back(sum / count);
    out.force_N.push_back(steps.force_N[step]);
  }
  return out;
}

}  // namespace asperity
