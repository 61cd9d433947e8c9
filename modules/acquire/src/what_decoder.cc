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
constexpr double kRateError = 0.02;
constexpr std::size_t kLearn_frames = 128;
constexpr std::int64_t kStretch_frames = 20;
constexpr double kLate_periods = 0.7;
constexpr double kEarly_periods = 0.6;
constexpr std::int64_t kHold_ns = 20'000'000;
constexpr int kHold_reads = 8;
constexpr std::size_t kMostHeld = 512;
constexpr std::int64_t kSilence_ns = 2'000'000'000;
constexpr double kLeastSpacing = 0.4;  // of a period

DeviceClockConfig clock_config(double period_ns, double rate_error) {
  DeviceClockConfig config;
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
  number_frame(timed);
  last_raw_ns_ = std::max(last_raw_ns_, timed.raw_ns);
  ++statistics_.frames;
  ++statistics_.samples;
  ++statistics_.force_samples;
  if (!pace_known_) {
    learn(timed);
    held_.push_back(timed);
    release(out);
    return;
  }
  decide(timed, out);
}

void WhatDecoder::number_frame(Timed& timed) {
  const auto skipped = static_cast<std::int64_t>((timed.frame.skipped + kFrame_bytes / 2) / kFrame_bytes);
  if (timed.frame.skipped > 0)
    statistics_.damaged_frames += static_cast<std::uint64_t>(std::max<std::int64_t>(1, skipped));
  if (!has_last_) {
    has_last_ = true;
    last_raw_ns_ = timed.raw_ns;
  } else if (timed.raw_ns - last_raw_ns_ > kSilence_ns) {
    const auto silent = static_cast<double>(timed.raw_ns - last_raw_ns_) / (period_ns_ * clock_.rate());
    last_number_ += std::max<std::int64_t>(1, std::llround(std::min(silent, 1e9)));
    pace_known_ = false;
    learned_.clear();
    seen_ = 0;
    clock_.restart(clock_config(period_ns_, kFirstRateError));
  } else {
    last_number_ += 1 + skipped;
  }
  timed.number = last_number_;
}

void WhatDecoder::learn(const Timed& timed) {
  clock_.observe(device_ns(timed.number), timed.raw_ns);
  if (timed.newest) learned_.push_back(timed);
  if (++seen_ >= kLearn_frames) settle_pace();
}

// The median pace over stretches: a few losses or late pieces do not move it.
void WhatDecoder::settle_pace() {
  std::vector<double> paces_ns;
  std::size_t back = 0;
  for (const Timed& timed : learned_) {
    while (timed.number - learned_[back].number > kStretch_frames) ++back;
    const std::int64_t frames = timed.number - learned_[back].number;
    if (frames < kStretch_frames / 2) continue;
    paces_ns.push_back(static_cast<double>(timed.raw_ns - learned_[back].raw_ns) / static_cast<double>(frames));
  }
  if (paces_ns.size() > 8) {
    const auto middle = paces_ns.begin() + static_cast<std::ptrdiff_t>(paces_ns.size() / 2);
    std::nth_element(paces_ns.begin(), middle, paces_ns.end());
    period_ns_ = std::clamp(*middle, kShortestPeriod_ns, kLongestPeriod_ns);
    clock_.restart(clock_config(period_ns_, kRateError));
    for (const Timed& timed : learned_) clock_.observe(device_ns(timed.number), timed.raw_ns);
    pace_known_ = true;
  }
  learned_.clear();
  seen_ = 0;
}

double WhatDecoder::late_periods(const Timed& timed) const {
  return static_cast<double>(timed.raw_ns - clock_.line_ns(device_ns(timed.number))) / (period_ns_ * clock_.rate());
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
  for (Timed& held : held_) held.number += frames;
  last_number_ += frames;
}

void WhatDecoder::release(std::vector<ProbeSample>& out) {
  for (const Timed& timed : held_) {
    if (pace_known_) clock_.observe(device_ns(timed.number), timed.raw_ns);
    ProbeSample& sample = out.emplace_back();
    sample.t_ns = clock_.stamp(device_ns(timed.number));
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

std::int64_t WhatDecoder::device_ns(std::int64_t number) const {
  return std::llround(period_ns_ * static_cast<double>(number));
}

}  // namespace asperity
