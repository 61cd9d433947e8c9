#include "pose_at.h"

#include <algorithm>

namespace asperity {

std::int64_t median_interval_ns(const std::vector<std::int64_t>& t_ns) {
  std::vector<std::int64_t> steps;
  for (std::size_t i = 1; i < t_ns.size(); ++i) steps.push_back(t_ns[i] - t_ns[i - 1]);
  if (steps.empty()) return 0;
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
}

PoseAt::PoseAt(const PoseStream& pose) : pose_(pose) {
  constexpr std::int64_t kGapIntervals = 10;
  longest_gap_ns_ = kGapIntervals * median_interval_ns(pose.t_ns);
}

std::optional<Pose> PoseAt::interpolate(std::int64_t t_ns) {
  const auto& times = pose_.t_ns;
  if (times.size() < 2 || t_ns < times.front() || t_ns > times.back()) return std::nullopt;
  if (times[row_] > t_ns) row_ = 0;
  constexpr std::size_t kNear = 16;
  for (std::size_t i = 0; i < kNear && row_ + 2 < times.size() && times[row_ + 1] <= t_ns; ++i) ++row_;
  if (times[row_ + 1] < t_ns) {
    const auto behind = std::upper_bound(times.begin(), times.end(), t_ns) - times.begin();
    row_ = std::min(static_cast<std::size_t>(behind) - 1, times.size() - 2);
  }
  const std::int64_t step = times[row_ + 1] - times[row_];
  if (step > longest_gap_ns_) return std::nullopt;
  const double share = static_cast<double>(t_ns - times[row_]) / static_cast<double>(step);
  const Pose &a = pose_.T_world_body[row_], &b = pose_.T_world_body[row_ + 1];
  return Pose{slerp(a.rotation, b.rotation, share), lerp(a.translation_m, b.translation_m, share)};
}

}  // namespace asperity
