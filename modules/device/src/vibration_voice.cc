#include "vibration_voice.h"

#include <algorithm>
#include <cmath>

#include "asperity/base/smoothstep.h"
#include "soft_limit.h"

namespace asperity {

namespace {

constexpr double kMostCorrection = 0.03;   // of the rate: below the 10 % that a fingertip notices
constexpr double kCorrectionTime_s = 0.3;  // in which an excess is used up
constexpr double kSmoothingTime_s = 0.1;   // of the measured excess: blocks and ticks come in steps

}  // namespace

VibrationVoice::VibrationVoice(const VibrationConfig& config, std::size_t block_samples, Clock clock)
    : step_(config.servo_rate_Hz / config.audio_rate_Hz),
      gain_step_(1.0 / std::max(1.0, config.fade_s * config.audio_rate_Hz)),
      level_per_N_(config.volume / config.full_scale_N),
      ceiling_(config.ceiling),
      most_(largest_float_within(config.ceiling)),
      clock_(clock),
      wanted_(clock == Clock::kCommon
                  ? 1.0
                  : std::min(0.5 * kMostWaiting, config.buffer_s * config.servo_rate_Hz +
                                                     static_cast<double>(block_samples) * step_ + 1.0)),
      ring_rate_(1.0 / (kSmoothingTime_s * config.audio_rate_Hz)),
      high_pass_(SecondOrderFilter::high_pass(config.high_pass_Hz, config.audio_rate_Hz)) {}

void VibrationVoice::push(double force_N) noexcept {
  if (std::isfinite(force_N)) queue_.push(force_N);
}

void VibrationVoice::begin() noexcept {
  double before_N = 0.0;
  while (clock_ == Clock::kOwn && static_cast<double>(queue_.read_available()) > wanted_) queue_.pop(before_N);
  // Before the first force the hand was free. After a gap nobody knows what it was, and a step would be made up.
  before_N = 0.0;
  if (ever_played_) queue_.pop(before_N);
  reader_.fill(before_N);
  high_pass_.start_high_pass_at(before_N);
  last_force_ = before_N;
  fraction_ = excess_ = ramp_ = 0.0;
  correction_ = 1.0;
  fading_out_ = false;
  playing_ = ever_played_ = true;
}

double VibrationVoice::next_sample() noexcept {
  const double level = smoothstep(ramp_) * soft_limit(level_per_N_ * high_pass_(reader_.at(fraction_)), ceiling_);
  ramp_ = std::clamp(ramp_ + (fading_out_ ? -gain_step_ : gain_step_), 0.0, 1.0);
  for (fraction_ += step_ * correction_; fraction_ >= 1.0; fraction_ -= 1.0) {
    // Without a next force the last one is held: what is already on its way is heard while fading out.
    if (!queue_.pop(last_force_)) fading_out_ = true;
    reader_.shift(last_force_);
  }
  return level;
}

void VibrationVoice::render(std::span<float> out) noexcept {
  const bool finishing = finishing_.load();
  const auto waiting = static_cast<double>(queue_.read_available());
  if (!playing_ && !finishing && waiting >= wanted_) begin();
  if (playing_) {
    if (finishing) fading_out_ = true;
    if (clock_ == Clock::kOwn) {
      // The driver slept: what waits is old. Fade out, forget it, begin anew.
      if (waiting > 4.0 * wanted_ + 64.0) fading_out_ = true;
      excess_ += std::min(1.0, static_cast<double>(out.size()) * ring_rate_) * (waiting - wanted_ - excess_);
      const double servo_rate_Hz = step_ / (ring_rate_ * kSmoothingTime_s);
      correction_ = 1.0 + std::clamp(excess_ / (servo_rate_Hz * kCorrectionTime_s), -kMostCorrection, kMostCorrection);
    }
  }
  const bool silent = !playing_;
  for (float& sample : out) {
    sample = playing_ ? std::clamp(static_cast<float>(next_sample()), -most_, most_) : 0.0F;
    if (fading_out_ && ramp_ == 0.0) playing_ = false;
  }
  if (finishing && silent) finished_.store(true);
}

}  // namespace asperity
