#include "what_decoder.h"

#include <algorithm>
#include <cmath>

namespace asperity {

namespace {

constexpr double kByte_ns = 1e9 * 10.0 / 115200.0;
constexpr std::uint64_t kFrame_bytes = 5;
constexpr double kFirstPeriod_ns = 1e9 / 450.0;
constexpr double kShortestPeriod_ns = 1e9 / 600.0;
constexpr double kLongestPeriod_ns = 1e9 / 300.0;
constexpr double kFirstRateError = 0.15;
constexpr double kLearningRateError = 0.01;
constexpr double kRateError = 0.003;
constexpr double kRelearnRateError = 0.002;
constexpr std::size_t kLearn_frames = 128;
constexpr std::size_t kLearnWell_frames = 512;
constexpr std::size_t kRelearn_frames = 64;
constexpr std::size_t kMarks = 512;
constexpr double kLate_periods = 0.8;
constexpr double kEarly_periods = 0.25;
constexpr std::int64_t kHold_ns = 20'000'000;
constexpr int kHold_reads = 8;
constexpr std::size_t kMostHeld = 512;
constexpr std::int64_t kSilence_ns = 2'000'000'000;
constexpr double kWindow_s = 4.0;      // the pace may drift by parts in 10⁴ a second
constexpr double kLeastSpacing = 0.4;  // of a period

DeviceClockConfig clock_config(double period_ns, double rate_error) {
  DeviceClockConfig config;
  config.window_s = kWindow_s;
  config.max_rate_error = rate_error;
  config.min_spacing_ns = std::llround(kLeastSpacing * period_ns);
  return config;
}

}  // namespace

WhatDecoder::WhatDecoder() : clock_(clock_config(kFirstPeriod_ns, kFirstRateError)), period_ns_(kFirstPeriod_ns) {
  statistics_.losses_are_estimated = true;
}

void WhatDecoder::push(std::span<const std::uint8_t> bytes, std::int64_t arrival_ns, std::vector<ProbeSample>& out) {
  if (bytes.empty()) return;
  statistics_.bytes += bytes.size();
  received_ += bytes.size();
  pieces_.push_back({received_, arrival_ns});
  frames_.clear();
  framer_.push(bytes, frames_);
  statistics_.resyncs = framer_.resyncs();
  for (const WhatFrame& frame : frames_) take(time_of(frame), out);
  while (pieces_.size() > 1 && pieces_.front().end <= framer_.settled()) pieces_.pop_front();
}

WhatDecoder::Timed WhatDecoder::time_of(const WhatFrame& frame) {
  while (pieces_.front().end < frame.end) pieces_.pop_front();
  const Piece& piece = pieces_.front();
  Timed timed;
  timed.frame = frame;
  timed.newest = piece.end - frame.end < kFrame_bytes;
  const auto bytes_since_start = static_cast<double>(piece.end - frame.end + kFrame_bytes);
  timed.raw_ns = piece.arrival_ns - std::llround(kByte_ns * bytes_since_start);
  return timed;
}

void WhatDecoder::take(Timed timed, std::vector<ProbeSample>& out) {
  const auto skipped = static_cast<std::int64_t>((timed.frame.skipped + kFrame_bytes / 2) / kFrame_bytes);
  if (timed.frame.skipped > 0) {
    statistics_.damaged_frames += static_cast<std::uint64_t>(std::max<std::int64_t>(1, skipped));
  }
  ++statistics_.frames;
  ++statistics_.samples;
  ++statistics_.force_samples;
  std::int64_t ahead = 1 + skipped;
  if (!has_last_) {
    has_last_ = true;
    last_raw_ns_ = timed.raw_ns;
    ahead = 0;
  } else if (timed.raw_ns - last_raw_ns_ > kSilence_ns) {
    release(out);
    const auto silent = static_cast<double>(timed.raw_ns - last_raw_ns_) / (period_ns_ * clock_.rate());
    ahead = std::max<std::int64_t>(1, std::llround(std::min(silent, 1e9)));
    begin_learning();
  }
  number_ += ahead;
  count_ += ahead;
  device_ns_ += static_cast<double>(ahead) * period_ns_;
  timed.number = number_;
  timed.device_ns = device_ns_;
  last_raw_ns_ = std::max(last_raw_ns_, timed.raw_ns);
  learn(timed);
  if (learned_ >= kLearn_frames) {
    decide(timed, out);
  } else {
    held_.push_back(timed);
    release(out);
  }
}

void WhatDecoder::begin_learning() {
  marks_.clear();
  learned_ = 0;
  clock_.restart(clock_config(period_ns_, kFirstRateError));
}

void WhatDecoder::learn(const Timed& timed) {
  if (timed.newest) {
    if (marks_.size() == kMarks) marks_.pop_front();
    marks_.push_back({count_, timed.device_ns, timed.raw_ns});
  }
  // Frames that waited for a busy host say nothing about the pace; the newest of a read does.
  if (marks_.empty()) return;
  ++learned_;
  if (learned_ == kLearn_frames || learned_ == kLearnWell_frames) {
    const double pace_ns = median_pace_ns();
    if (pace_ns > 0.0) period_ns_ = std::clamp(pace_ns, kShortestPeriod_ns, kLongestPeriod_ns);
    begin_clock(learned_ == kLearn_frames ? kLearningRateError : kRateError);
  } else if (learned_ > kLearnWell_frames && learned_ % kRelearn_frames == 0 &&
             std::abs(clock_.rate() - 1.0) > kRelearnRateError) {
    period_ns_ = std::clamp(period_ns_ * clock_.rate(), kShortestPeriod_ns, kLongestPeriod_ns);
    begin_clock(kRateError);
  }
}

// Over stretches of a third of what is known, at most 100 frames; 0 if there are too few.
double WhatDecoder::median_pace_ns() const {
  if (marks_.size() < 2) return 0.0;
  std::vector<double> paces_ns;
  paces_ns.reserve(marks_.size());
  const std::int64_t stretch = std::min<std::int64_t>(100, (marks_.back().count - marks_.front().count) / 3);
  std::size_t back = 0;
  for (const Mark& mark : marks_) {
    while (mark.count - marks_[back + 1].count >= stretch && &marks_[back + 1] != &mark) ++back;
    const std::int64_t frames = mark.count - marks_[back].count;
    if (frames < std::max<std::int64_t>(1, stretch)) continue;
    paces_ns.push_back(static_cast<double>(mark.raw_ns - marks_[back].raw_ns) / static_cast<double>(frames));
  }
  if (paces_ns.size() < 8) return 0.0;
  const auto middle = paces_ns.begin() + static_cast<std::ptrdiff_t>(paces_ns.size() / 2);
  std::nth_element(paces_ns.begin(), middle, paces_ns.end());
  return *middle;
}

// The device's time is counted anew at the pace that is known now, back to the oldest mark.
void WhatDecoder::begin_clock(double rate_error) {
  clock_.restart(clock_config(period_ns_, rate_error));
  const double end_ns = marks_.back().device_ns;
  for (Mark& mark : marks_) {
    mark.device_ns = end_ns - static_cast<double>(marks_.back().count - mark.count) * period_ns_;
    clock_.observe(std::llround(mark.device_ns), mark.raw_ns);
  }
}

double WhatDecoder::late_periods(const Timed& timed) const {
  const std::int64_t line_ns = clock_.line_ns(std::llround(timed.device_ns));
  return static_cast<double>(timed.raw_ns - line_ns) / (period_ns_ * clock_.rate());
}

void WhatDecoder::decide(const Timed& timed, std::vector<ProbeSample>& out) {
  if (!timed.newest) {
    held_.push_back(timed);
    if (held_.size() > kMostHeld) release(out);
    return;
  }
  const double late = late_periods(timed);
  if (held_late_ > 0 && late > last_late_ + kLate_periods)
    release(out);  // lost in between: those before were merely late
  held_.push_back(timed);
  if (late < -kEarly_periods) {
    put_forward(std::min<std::int64_t>(-1, std::llround(std::max(late, -1e6))));
    release(out);
    return;
  }
  if (late <= kLate_periods) {
    release(out);
    return;
  }
  if (held_late_++ == 0) {
    least_late_ = late;
    held_since_ns_ = timed.raw_ns;
  }
  last_late_ = late;
  least_late_ = std::min(least_late_, late);
  const bool decided = held_late_ >= kHold_reads && timed.raw_ns - held_since_ns_ >= kHold_ns;
  if (!decided && held_.size() <= kMostHeld) return;
  // Even the least late frame may have been a little late itself: the number is rather too low than too high.
  put_forward(std::max<std::int64_t>(1, static_cast<std::int64_t>(std::floor(least_late_ + 1.0 - kLate_periods))));
  release(out);
}

void WhatDecoder::put_forward(std::int64_t frames) {
  const double ahead_ns = static_cast<double>(frames) * period_ns_;
  for (Timed& held : held_) {
    held.number += frames;
    held.device_ns += ahead_ns;
  }
  number_ += frames;
  device_ns_ += ahead_ns;
}

void WhatDecoder::release(std::vector<ProbeSample>& out) {
  for (const Timed& timed : held_) {
    clock_.observe(std::llround(timed.device_ns), timed.raw_ns);
    ProbeSample& sample = out.emplace_back();
    sample.t_ns = clock_.stamp(std::llround(timed.device_ns));
    for (int axis = 0; axis < 3; ++axis) sample.accel_counts[axis] = timed.frame.data[static_cast<std::size_t>(axis)];
    sample.force_counts = timed.frame.data[3];
    count_lost(timed.number);
  }
  held_.clear();
  held_late_ = 0;
}

void WhatDecoder::count_lost(std::int64_t number) {
  ++given_;
  const std::int64_t lost = number + 1 - given_;
  if (lost > static_cast<std::int64_t>(statistics_.lost_frames)) {
    statistics_.lost_frames = static_cast<std::uint64_t>(lost);
    statistics_.lost_samples = statistics_.lost_frames;
  }
}

}  // namespace asperity
