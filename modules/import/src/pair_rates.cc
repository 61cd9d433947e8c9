#include <algorithm>

#include "asperity/import/check_streams.h"
#include "pose_at.h"
#include "running_integral.h"

namespace asperity {

RatePairs pair_rates(const PoseStream& pose, const VectorStream& rate, std::int64_t pose_ahead_ns) {
  RatePairs out;
  if (pose.size() < 2 || rate.size() < 2) return out;
  constexpr std::int64_t kStretch_ns = 40'000'000;
  const std::int64_t stretch_ns = std::max(kStretch_ns, 2 * median_interval_ns(pose.t_ns));
  const RunningIntegral turned(rate.t_ns, rate.value);
  std::size_t from = 0;
  for (std::size_t i = 1; i < pose.size(); ++i) {
    const std::int64_t length_ns = pose.t_ns[i] - pose.t_ns[from];
    if (length_ns < stretch_ns) continue;
    const std::size_t begin = std::exchange(from, i);
    if (length_ns > 2 * stretch_ns) continue;
    const auto angle = turned.between(pose.t_ns[begin] + pose_ahead_ns, pose.t_ns[i] + pose_ahead_ns);
    if (!angle) continue;
    const double length_s = static_cast<double>(length_ns) * 1e-9;
    const Eigen::Quaterniond turn = pose.T_world_body[begin].rotation.conjugate() * pose.T_world_body[i].rotation;
    out.pose_radps.push_back(log_rotation(turn) / length_s);
    out.gyro_radps.push_back(*angle / length_s);
  }
  return out;
}

}  // namespace asperity
