#include "scan/scan_book.h"

#include <utility>

namespace asperity::studio {

namespace {

Json base_json(const LiveBase& base) {
  Json out;
  out["known"] = base.known;
  out["shape"] = kPathShapeNames.at(static_cast<std::size_t>(base.shape));
  out["normal_world"] = {base.normal_world.x(), base.normal_world.y(), base.normal_world.z()};
  out["normal_sigma_deg"] = base.normal_sigma_deg;
  out["settled"] = base.settled;
  return out;
}

template <class T>
std::span<const T> tail(const std::vector<T>& values, std::size_t first) {
  return std::span(values).subspan(first);
}

}  // namespace

void ScanBook::begin_anew() {
  const ScanBook before = std::move(*this);
  *this = ScanBook();
  generation_ = before.generation_ + 1;
  profile_sequence_ = before.profile_sequence_;
  path_sequence_ = before.path_sequence_;
}

void ScanBook::add(const LiveEstimate& estimate, bool storing) {
  base_ = estimate.base;
  motion_ns_ = estimate.motion_ns;
  if (!storing && t_ns_.size() >= kMostTipsInTheAir && s_m_.empty()) begin_anew();
  for (const LiveTip& tip : estimate.tips) {
    if (t_ns_.size() >= kMostTips) break;
    t_ns_.push_back(tip.t_ns);
    for (int axis = 0; axis < 3; ++axis) {
      tips_m_.push_back(static_cast<float>(tip.p_world_tip_m[axis]));
      axes_.push_back(static_cast<float>(tip.probe_axis_world[axis]));
    }
    force_N_.push_back(static_cast<float>(tip.force_N));
    state_.push_back(static_cast<std::uint8_t>(tip.usable ? 2 : tip.contact ? 1 : 0));
  }
  if (!storing) return;
  for (const LivePoint& point : estimate.points) {
    if (s_m_.size() >= kMostPoints) break;
    s_m_.push_back(point.s_m);
    height_m_.push_back(point.height_m);
    sigma_m_.push_back(static_cast<float>(point.sigma_m));
    texture_m_.push_back(static_cast<float>(point.texture_m));
    point_force_N_.push_back(static_cast<float>(point.force_N));
    speed_mps_.push_back(static_cast<float>(point.speed_mps));
  }
}

BlockWriter ScanBook::profile_from(std::size_t first) const {
  BlockWriter out("scan.profile");
  out.head()["generation"] = generation_;
  out.head()["first"] = first;
  out.head()["motion_ns"] = motion_ns_;
  out.head()["base"] = base_json(base_);
  out.add("s_m", tail(s_m_, first));
  const auto heights = tail(height_m_, first);
  const std::vector<float> height_m(heights.begin(), heights.end());
  out.add("height_m", std::span<const float>(height_m));
  out.add("sigma_m", tail(sigma_m_, first));
  out.add("texture_m", tail(texture_m_, first));
  out.add("force_N", tail(point_force_N_, first));
  out.add("speed_mps", tail(speed_mps_, first));
  return out;
}

BlockWriter ScanBook::path_from(std::size_t first) const {
  BlockWriter out("scan.pose");
  out.head()["generation"] = generation_;
  out.head()["first"] = first;
  out.head()["motion_ns"] = motion_ns_;
  out.add("tip_m", tail(tips_m_, 3 * first), {t_ns_.size() - first, 3});
  out.add("axis", tail(axes_, 3 * first), {t_ns_.size() - first, 3});
  out.add("force_N", tail(force_N_, first));
  out.add("state", tail(state_, first));
  return out;
}

BlockWriter ScanBook::take_growth() {
  BlockWriter out = profile_from(told_points_);
  out.head()["sequence"] = profile_sequence_++;
  told_points_ = s_m_.size();
  return out;
}

BlockWriter ScanBook::take_motion() {
  BlockWriter out = path_from(told_tips_);
  out.head()["sequence"] = path_sequence_++;
  told_tips_ = t_ns_.size();
  return out;
}

}  // namespace asperity::studio
