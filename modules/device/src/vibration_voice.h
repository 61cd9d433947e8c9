#pragma once

#include <atomic>
#include <cstddef>
#include <span>

#include "asperity/device/second_order_filter.h"
#include "asperity/device/vibration_config.h"
#include "band_limited_reader.h"
#include "spsc_queue.h"

namespace asperity {

// From forces at the servo's rate to samples at the audio rate: queue, band-limited interpolation, high-pass, soft
// limit, fades. push() on one thread, render() on another; neither allocates, locks nor waits.
class VibrationVoice {
 public:
  // How render() keeps step with push().
  enum class Clock {
    kOwn,     // two clocks: the interpolation is drawn out or hurried by up to 3 % to keep the queue filled
    kCommon,  // exactly servo_rate_Hz to audio_rate_Hz, for files
  };

  // `block_samples` is the usual length of render(). The config has been checked.
  VibrationVoice(const VibrationConfig& config, std::size_t block_samples, Clock clock);

  void push(double force_N) noexcept;

  // Fills `out`; every sample is within ±ceiling.
  void render(std::span<float> out) noexcept;

  // Fades out and stays silent. Any thread.
  void finish() noexcept { finishing_.store(true); }

  // After finish(): a whole render() was silent. Any thread.
  bool finished() const noexcept { return finished_.load(); }

  // Samples from a force's push to its sound in kCommon.
  double delay_samples() const noexcept { return static_cast<double>(BandLimitedReader::kAhead + 1) / step_; }

 private:
  void begin() noexcept;
  double next_sample() noexcept;

  static constexpr std::size_t kMostWaiting = 4096;

  SpscQueue<double> queue_{kMostWaiting};
  std::atomic<bool> finishing_{false}, finished_{false};

  // The rendering thread's.
  double step_, gain_step_, level_per_N_, ceiling_;
  float most_;
  Clock clock_;
  double wanted_;     // forces in the queue at the begin of a block
  double ring_rate_;  // of the correction's smoothing, per sample
  BandLimitedReader reader_;
  SecondOrderFilter high_pass_;
  bool playing_ = false, fading_out_ = false, ever_played_ = false;
  double fraction_ = 0.0, ramp_ = 0.0, last_force_ = 0.0;
  double excess_ = 0.0, correction_ = 1.0;
};

}  // namespace asperity
