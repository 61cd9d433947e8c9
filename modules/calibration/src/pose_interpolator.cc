#include "pose_interpolator.h"

#include <algorithm>
#include <utility>

namespace asperity {

PoseInterpolator::PoseInterpolator(std::vector<double> t_s, const std::vector<Pose>& poses)
    : t_s_(std::move(t_s)), poses_(poses) {}

Pose PoseInterpolator::at(double t_s, Cursor& cursor) const {
  std::size_t& row = cursor.row;
  if (row + 1 >= t_s_.size() || t_s_[row] > t_s) {
    const auto after = std::upper_bound(t_s_.begin(), t_s_.end(), t_s);
    row = after == t_s_.begin() ? 0 : static_cast<std::size_t>(after - t_s_.begin()) - 1;
  }
  while (row + 2 < t_s_.size() && t_s_[row + 1] <= t_s) ++row;
  const std::size_t first = std::min(row == 0 ? 0 : row - 1, t_s_.size() - 4);
  const Pose& reference = poses_[first + 1];
  if (first != cursor.first) {
    cursor.first = first;
    for (std::size_t i = 0; i < 4; ++i) {
      cursor.turns[i] = log_rotation(reference.rotation.conjugate() * poses_[first + i].rotation);
    }
  }
  Pose out;
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < 4; ++i) {
    double weight = 1.0;
    for (std::size_t j = 0; j < 4; ++j) {
      if (j != i) weight *= (t_s - t_s_[first + j]) / (t_s_[first + i] - t_s_[first + j]);
    }
    out.translation_m += weight * poses_[first + i].translation_m;
    turn += weight * cursor.turns[i];
  }
  out.rotation = reference.rotation * exp_rotation(turn);
  return out;
}

}  // namespace asperity
