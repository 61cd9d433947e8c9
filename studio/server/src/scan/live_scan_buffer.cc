#include "scan/live_scan_buffer.h"

#include <algorithm>
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

LiveScanBuffer LiveScanBuffer::restart() {
  LiveScanBuffer before = std::move(*this);
  *this = LiveScanBuffer();
  profile_generation_ = before.profile_generation_ + 1;
  path_generation_ = before.path_generation_ + 1;
  profile_sequence_ = before.profile_sequence_;
  path_sequence_ = before.path_sequence_;
  begun_anew_ = true;
  return before;
}

void LiveScanBuffer::begin_with(LiveScanBuffer kept) {
  restart();
  kept.profile_generation_ = profile_generation_;
  kept.path_generation_ = path_generation_;
  kept.profile_sequence_ = profile_sequence_;
  kept.path_sequence_ = path_sequence_;
  kept.sent_points_ = kept.sent_tips_ = 0;
  kept.begun_anew_ = true;
  *this = std::move(kept);
}

void LiveScanBuffer::restart_path() {
  ++path_generation_;
  sent_tips_ = 0;
}

void LiveScanBuffer::add_tip(const LiveTip& tip, bool storing) {
  if (++passed_over_ < stride_) return;
  passed_over_ = 0;
  if (!storing && path_.size() >= stored_tips_ + kMostTipsInTheAir) {
    path_.resize(stored_tips_);
    restart_path();
  }
  if (path_.size() >= kMostTips) {
    for (std::size_t i = 0; 2 * i < path_.size(); ++i) path_[i] = path_[2 * i];
    path_.resize((path_.size() + 1) / 2);
    stored_tips_ = std::min(stored_tips_, path_.size());
    stride_ *= 2;
    restart_path();
  }
  Tip out{};
  for (int axis = 0; axis < 3; ++axis) {
    out.p_m[axis] = static_cast<float>(tip.p_world_tip_m[axis]);
    out.axis[axis] = static_cast<float>(tip.probe_axis_world[axis]);
  }
  out.force_N = static_cast<float>(tip.force_N);
  out.state = static_cast<std::uint8_t>(tip.usable ? 2 : tip.contact ? 1 : 0);
  path_.push_back(out);
  if (storing) stored_tips_ = path_.size();
}

void LiveScanBuffer::add(const LiveEstimate& estimate, bool storing) {
  base_ = estimate.base;
  motion_ns_ = estimate.motion_ns;
  for (const LiveTip& tip : estimate.tips) add_tip(tip, storing);
  if (!storing) return;
  for (const LivePoint& point : estimate.points) {
    if (s_m_.size() >= kMostPoints) break;
    s_m_.push_back(point.s_m);
    height_m_.push_back(static_cast<float>(point.height_m));
    sigma_m_.push_back(static_cast<float>(point.sigma_m));
    texture_m_.push_back(static_cast<float>(point.texture_m));
    force_N_.push_back(static_cast<float>(point.force_N));
    speed_mps_.push_back(static_cast<float>(point.speed_mps));
  }
}

BlockWriter LiveScanBuffer::profile_from(std::size_t first) const {
  BlockWriter out("scan.profile");
  out.head()["generation"] = profile_generation_;
  out.head()["first"] = first;
  out.head()["motion_ns"] = motion_ns_;
  out.head()["base"] = base_json(base_);
  out.add("s_m", tail(s_m_, first));
  out.add("height_m", tail(height_m_, first));
  out.add("sigma_m", tail(sigma_m_, first));
  out.add("texture_m", tail(texture_m_, first));
  out.add("force_N", tail(force_N_, first));
  out.add("speed_mps", tail(speed_mps_, first));
  return out;
}

BlockWriter LiveScanBuffer::path_from(std::size_t first) const {
  const std::size_t count = path_.size() - first;
  std::vector<float> tips_m, axes, force_N;
  std::vector<std::uint8_t> state;
  tips_m.reserve(3 * count);
  axes.reserve(3 * count);
  for (const Tip& tip : tail(path_, first)) {
    tips_m.insert(tips_m.end(), tip.p_m, tip.p_m + 3);
    axes.insert(axes.end(), tip.axis, tip.axis + 3);
    force_N.push_back(tip.force_N);
    state.push_back(tip.state);
  }
  BlockWriter out("scan.pose");
  out.head()["generation"] = path_generation_;
  out.head()["first"] = first;
  out.head()["motion_ns"] = motion_ns_;
  out.add("tip_m", std::span<const float>(tips_m), {count, 3});
  out.add("axis", std::span<const float>(axes), {count, 3});
  out.add("force_N", std::span<const float>(force_N));
  out.add("state", std::span<const std::uint8_t>(state));
  return out;
}

BlockWriter LiveScanBuffer::take_growth() {
  BlockWriter out = profile_from(sent_points_);
  out.head()["sequence"] = profile_sequence_++;
  sent_points_ = s_m_.size();
  begun_anew_ = false;
  return out;
}

BlockWriter LiveScanBuffer::take_motion() {
  BlockWriter out = path_from(sent_tips_);
  out.head()["sequence"] = path_sequence_++;
  sent_tips_ = path_.size();
  return out;
}

}  // namespace asperity::studio
