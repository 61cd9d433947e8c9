#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "asperity/device/duration_histogram.h"
#include "asperity/device/second_order_filter.h"
#include "asperity/device/servo_tick.h"
#include "asperity/device/vibration_axis.h"
#include "asperity/studio/hub.h"

namespace asperity::studio {

inline constexpr const char* kFeelStateTopic = "feel.state";
inline constexpr const char* kFeelTicksTopic = "feel.ticks";
inline constexpr const char* kFeelSoundTopic = "feel.sound";

// What the browsers see of a run, made of its ticks in order, 60 frames a second (docs/studio-feel.md): the newest
// state, every tick's numbers, and the vibration as a sound at the servo's rate. What nobody has subscribed to is not
// made. On one thread, not the servo's.
class TickStream {
 public:
  // A blind one has neither ticks nor what would tell one texture from another: the parts of the force, the height.
  TickStream(Hub& hub, double rate_Hz, std::uint64_t run, bool blind = false);

  void add(const ServoTick& tick);
  // What has not been sent yet, at the end of a run.
  void flush();

 private:
  void follow(const ServoTick& tick);
  void add_sound(const ServoTick& tick, std::int64_t ticks_since);
  void send_state();
  void send_ticks();
  void send_sound();

  Hub& hub_;
  double rate_Hz_;
  std::uint64_t run_;
  bool blind_;
  std::uint64_t frame_ticks_;  // between two frames
  bool wants_state_ = false, wants_ticks_ = false, wants_sound_ = false;

  ServoTick last_;
  std::uint64_t ticks_ = 0, skipped_ = 0, since_frame_ = 0;
  Eigen::Vector3d v_world_mps_ = Eigen::Vector3d::Zero();
  double way_m_ = 0.0;
  std::uint32_t limited_by_ = 0;             // since the last state
  std::unique_ptr<DurationHistogram> late_;  // of this second
  std::uint64_t late_until_ = 0;
  double late_p99_s_ = 0.0, late_max_s_ = 0.0;  // of the second before

  std::vector<double> t_s_;
  std::vector<float> contact_N_, texture_N_, friction_N_, out_N_, height_m_, way_mm_, speed_mps_;
  std::uint64_t ticks_sequence_ = 0;

  VibrationAxis axis_;
  SecondOrderFilter high_pass_;
  bool sounding_ = false;
  std::vector<float> sound_N_;
  std::uint64_t sound_sequence_ = 0;
};

}  // namespace asperity::studio
