#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "asperity/live/live_estimate.h"
#include "asperity/studio/block.h"

namespace asperity::studio {

// The profile and the tip's path as they have grown so far, and the frames by which they grow in a browser. A new
// generation begins from nothing: a browser that sees one it does not know, or a gap, asks for the whole.
class LiveScanBuffer {
 public:
  static constexpr std::size_t kMostPoints = 1'000'000;
  static constexpr std::size_t kMostTips = 100'000;  // then every other one goes
  static constexpr std::size_t kMostTipsInTheAir = 5'000;

  // Gives what there was.
  LiveScanBuffer restart();
  // Starts again with earlier data.
  void begin_with(LiveScanBuffer kept);
  // While nothing is stored only the path grows; of that the newest tips are kept.
  void add(const LiveEstimate& estimate, bool storing);

  // What add() has brought since the last call, with "sequence", "generation" and "first"; empty: nothing. That the
  // profile has started again is sent without a point, too: earlier points are out of date.
  bool grown() const { return begun_anew_ || sent_points_ < s_m_.size(); }
  bool moved() const { return sent_tips_ < path_.size(); }
  BlockWriter take_growth();
  BlockWriter take_motion();
  // All of it.
  BlockWriter profile() const { return profile_from(0); }
  BlockWriter path() const { return path_from(0); }

  std::span<const double> s_m() const { return s_m_; }
  std::span<const float> height_m() const { return height_m_; }

 private:
  struct Tip {
    float p_m[3], axis[3];
    float force_N;
    std::uint8_t state;  // 1: in contact, 2: enters the profile
  };
  BlockWriter profile_from(std::size_t first) const;
  BlockWriter path_from(std::size_t first) const;
  void add_tip(const LiveTip& tip, bool storing);
  void restart_path();

  std::uint32_t profile_generation_ = 0, path_generation_ = 0;
  std::uint64_t profile_sequence_ = 0, path_sequence_ = 0;
  std::size_t sent_points_ = 0, sent_tips_ = 0;
  bool begun_anew_ = false;
  LiveBase base_;
  std::int64_t motion_ns_ = 0;
  std::vector<double> s_m_;
  std::vector<float> height_m_, sigma_m_, texture_m_, force_N_, speed_mps_;
  std::vector<Tip> path_;
  std::size_t stored_tips_ = 0;  // those after them were only shown
  std::size_t stride_ = 1;       // of the tips that come, so many make one
  std::size_t passed_over_ = 0;
};

}  // namespace asperity::studio
