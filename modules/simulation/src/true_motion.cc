#include "asperity/simulation/true_motion.h"

#include <algorithm>
#include <cstddef>

#include "asperity/base/error.h"

namespace asperity {

TrueMotion::TrueMotion(const Recording& recording) {
  if (!recording.truth || recording.truth->size() == 0) throw Error("a recording without truth cannot be looked at");
  const Truth& truth = *recording.truth;
  t_ns_ = truth.t_ns;
  T_world_marker_.reserve(truth.size());
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const Eigen::Quaterniond& q = truth.q_world_marker[i];
    T_world_marker_.push_back({q, truth.p_world_tip_m[i] - q * recording.calibration.tip_in_marker_m});
  }
}

Pose TrueMotion::T_world_marker(std::int64_t t_ns) const {
  const auto after = std::upper_bound(t_ns_.begin(), t_ns_.end(), t_ns);
  if (after == t_ns_.begin()) return T_world_marker_.front();
  if (after == t_ns_.end()) return T_world_marker_.back();
  const auto i = static_cast<std::size_t>(after - t_ns_.begin());
  const double share = static_cast<double>(t_ns - t_ns_[i - 1]) / static_cast<double>(t_ns_[i] - t_ns_[i - 1]);
  const Pose& a = T_world_marker_[i - 1];
  const Pose& b = T_world_marker_[i];
  return {slerp(a.rotation, b.rotation, share), lerp(a.translation_m, b.translation_m, share)};
}

}  // namespace asperity
