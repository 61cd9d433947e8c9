#include "asperity/trajectory/sample_at_probe.h"

#include <algorithm>
#include <cmath>

#include "asperity/base/error.h"
#include "asperity/base/units.h"
#include "asperity/geometry/pose.h"

namespace asperity {

TipMotion sample_at_probe(const ProbeStream& probe, const Outliers& outliers, const Calibration& calibration,
                          const Eigen::Vector3d& gravity_world_mps2, const TipMotion& motion) {
  if (motion.size() == 0) throw Error("sampling a motion at the probe's times: the motion is empty");
  if (outliers.rejected.size() != probe.size())
    throw Error("sampling at the probe's times: outliers of another stream");
  const std::int64_t latency_ns = std::llround(calibration.probe_latency_s / kNanosecond_s);
  TipMotion out;
  std::size_t k = 0;  // motion sample at or before the probe's
  for (std::size_t i = 0; i < probe.size(); ++i) {
    const std::int64_t t_ns = probe.t_ns[i] - latency_ns;
    if (outliers.rejected[i] || t_ns < motion.t_ns.front() || t_ns > motion.t_ns.back()) continue;
    if (!probe.accel_counts[i].allFinite()) continue;
    while (k + 1 < motion.size() && motion.t_ns[k + 1] <= t_ns) ++k;
    const std::size_t next = std::min(k + 1, motion.size() - 1);
    const auto span_ns = static_cast<double>(std::max<std::int64_t>(1, motion.t_ns[next] - motion.t_ns[k]));
    const double part = static_cast<double>(t_ns - motion.t_ns[k]) / span_ns;
    const Eigen::Quaterniond q_world_marker = slerp(motion.q_world_marker[k], motion.q_world_marker[next], part);
    out.t_ns.push_back(t_ns);
    out.p_world_tip_m.push_back(lerp(motion.p_world_tip_m[k], motion.p_world_tip_m[next], part));
    out.v_world_tip_mps.push_back(lerp(motion.v_world_tip_mps[k], motion.v_world_tip_mps[next], part));
    out.q_world_marker.push_back(q_world_marker);
    out.a_world_tip_mps2.push_back(
        q_world_marker * calibration.accelerometer.specific_force_mps2(probe.accel_counts[i]) + gravity_world_mps2);
    out.force_N.push_back(calibration.force.force_N(probe.force_counts[i]));
  }
  return out;
}

}  // namespace asperity
