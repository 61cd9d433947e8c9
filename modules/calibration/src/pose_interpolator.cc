#include "pose_interpolator.h"

#include <algorithm>
#include <utility>

namespace asperity {

PoseInterpolator::PoseInterpolator(std::vector<double> t_s, const std::vector<Pose>& poses)
    : t_s_(std::move(t_s)), poses_(poses) {}

Pose PoseInterpolator::at(double t_s, std::size_t& hint) const {
  if (hint + 1 >= t_s_.size() || t_s_[hint] > t_s) {
    const auto after = std::upper_bound(t_s_.begin(), t_s_.end(), t_s);
    hint = after == t_s_.begin() ? 0 : static_cast<std::size_t>(after - t_s_.begin()) - 1;
  }
  while (hint + 2 < t_s_.size() && t_s_[hint + 1] <= t_s) ++hint;
  const std::size_t first = std::min(hint == 0 ? 0 : hint - 1, t_s_.size() - 4);
  const Pose& reference = poses_[first + 1];
  Pose out;
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();
  for (std::size_t i = first; i < first + 4; ++i) {
    double weight = 1.0;
    for (std::size_t j = first; j < first + 4; ++j) {
      if (j != i) weight *= (t_s - t_s_[j]) / (t_s_[i] - t_s_[j]);
    }
    out.translation_m += weight * poses_[i].translation_m;
    turn += weight * log_rotation(reference.rotation.conjugate() * poses_[i].rotation);
  }
  out.rotation = reference.rotation * exp_rotation(turn);
  return out;
}

}  // namespace asperity
