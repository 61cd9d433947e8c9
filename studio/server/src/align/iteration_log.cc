#include "align/iteration_log.h"

#include <span>

namespace asperity::studio {

void IterationLog::add(const RegistrationIteration& iteration) {
  const std::lock_guard lock(mutex_);
  if (iterations_.size() < kMost) iterations_.push_back(iteration);
}

std::optional<BlockWriter> IterationLog::take_news() {
  const std::lock_guard lock(mutex_);
  if (sent_ == iterations_.size()) return std::nullopt;
  BlockWriter out = block(sent_, iterations_.size());
  out.head()["topic"] = "align.iteration";
  out.head()["sequence"] = sequence_++;
  sent_ = iterations_.size();
  return out;
}

BlockWriter IterationLog::all() const {
  const std::lock_guard lock(mutex_);
  return block(0, iterations_.size());
}

BlockWriter IterationLog::block(std::size_t from, std::size_t to) const {
  std::vector<double> pose, rms_m;
  std::vector<std::uint8_t> phase;
  std::vector<std::uint32_t> start, points, inliers;
  for (std::size_t i = from; i < to; ++i) {
    const RegistrationIteration& each = iterations_[i];
    const Eigen::Vector3d& p = each.T_mesh_world.translation_m;
    const Eigen::Quaterniond& q = each.T_mesh_world.rotation;
    const double sign = q.w() < 0.0 ? -1.0 : 1.0;
    pose.insert(pose.end(), {p.x(), p.y(), p.z(), sign * q.w(), sign * q.x(), sign * q.y(), sign * q.z()});
    rms_m.push_back(each.rms_m);
    phase.push_back(static_cast<std::uint8_t>(each.phase));
    start.push_back(static_cast<std::uint32_t>(each.start));
    points.push_back(static_cast<std::uint32_t>(each.points));
    inliers.push_back(static_cast<std::uint32_t>(each.inliers));
  }
  BlockWriter out("align.iteration");
  out.head()["run"] = run_;
  out.head()["first"] = from;
  out.head()["phases"] = kRegistrationPhaseNames;
  out.add("T_mesh_world", std::span<const double>(pose), {to - from, 7});
  out.add("rms_m", std::span<const double>(rms_m));
  out.add("phase", std::span<const std::uint8_t>(phase));
  out.add("start", std::span<const std::uint32_t>(start));
  out.add("points", std::span<const std::uint32_t>(points));
  out.add("inliers", std::span<const std::uint32_t>(inliers));
  return out;
}

}  // namespace asperity::studio
