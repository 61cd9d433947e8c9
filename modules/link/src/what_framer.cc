#include "what_framer.h"

#include <algorithm>
#include <cmath>

namespace asperity {

namespace {

constexpr std::uint8_t kStartByte = 0xFF;
constexpr std::size_t kWhatFrame_bytes = 5;
constexpr std::size_t kWindow_bytes = 5 * kWhatFrame_bytes;
constexpr double kLead = 6.0;
constexpr double kForget = 1.0 / 32.0;
constexpr double kLeastRate = 0.02;
constexpr double kMostRate = 0.9;
constexpr double kOftenFull = 0.5;

}  // namespace

WhatFramer::WhatFramer() : start_rate_{0.99, 0.05, 0.05, 0.05, 0.05} {}

void WhatFramer::push(std::span<const std::uint8_t> bytes, std::vector<WhatFrame>& out) {
  bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  while (in_step_ ? step(out) : find_phase()) {
  }
  bytes_.erase(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(cursor_));
  base_ += cursor_;
  cursor_ = 0;
}

// False if more bytes are needed.
bool WhatFramer::step(std::vector<WhatFrame>& out) {
  const auto starts = [this](std::size_t frame) { return bytes_[cursor_ + frame * kWhatFrame_bytes] == kStartByte; };
  const std::size_t there = bytes_.size() - cursor_;
  if (there <= kWhatFrame_bytes) return false;
  if (starts(1)) {
    if (looks_odd()) {
      if (there <= kWindow_bytes) return false;
      const auto score = scores();
      if (*std::max_element(score.begin(), score.end()) > score[0] + kLead) {
        in_step_ = false;
        return true;
      }
    }
    take(out);
    return true;
  }
  if (there <= 3 * kWhatFrame_bytes) return false;
  if (starts(2) && starts(3)) {
    take(out);
    cursor_ += kWhatFrame_bytes;
  } else {
    in_step_ = false;
  }
  return true;
}

void WhatFramer::take(std::vector<WhatFrame>& out) {
  WhatFrame frame;
  const std::uint64_t start = base_ + cursor_;
  frame.skipped = start - taken_;
  frame.end = start + kWhatFrame_bytes;
  for (std::size_t i = 0; i < frame.data.size(); ++i) {
    frame.data[i] = bytes_[cursor_ + 1 + i];
    double& rate = start_rate_[1 + i];
    rate += kForget * ((frame.data[i] == kStartByte ? 1.0 : 0.0) - rate);
  }
  taken_ = frame.end;
  cursor_ += kWhatFrame_bytes;
  out.push_back(frame);
}

// True if a place that has mostly been FFh of late is not: a slip may have brought it under the start byte.
bool WhatFramer::looks_odd() const {
  for (std::size_t place = 1; place < kWhatFrame_bytes; ++place) {
    if (start_rate_[place] > kOftenFull && bytes_[cursor_ + place] != kStartByte) return true;
  }
  return false;
}

// The likelihoods of the phases over the window at the cursor.
std::array<double, 5> WhatFramer::scores() const {
  std::array<double, kWhatFrame_bytes> if_start{};
  std::array<double, kWhatFrame_bytes> if_not{};
  for (std::size_t place = 0; place < kWhatFrame_bytes; ++place) {
    const double rate = place == 0 ? start_rate_[0] : std::clamp(start_rate_[place], kLeastRate, kMostRate);
    if_start[place] = std::log(rate);
    if_not[place] = std::log(1.0 - rate);
  }
  std::array<int, kWhatFrame_bytes> seen{};  // start bytes, by place from the cursor
  for (std::size_t i = 0; i < kWindow_bytes; ++i) {
    if (bytes_[cursor_ + i] == kStartByte) ++seen[i % kWhatFrame_bytes];
  }
  std::array<double, kWhatFrame_bytes> score{};
  for (std::size_t phase = 0; phase < kWhatFrame_bytes; ++phase) {
    for (std::size_t place = 0; place < kWhatFrame_bytes; ++place) {
      const int hits = seen[(phase + place) % kWhatFrame_bytes];
      score[phase] +=
          hits * if_start[place] + (static_cast<int>(kWindow_bytes / kWhatFrame_bytes) - hits) * if_not[place];
    }
  }
  return score;
}

bool WhatFramer::find_phase() {
  if (bytes_.size() - cursor_ <= kWindow_bytes) return false;
  const auto score = scores();
  const auto best = static_cast<std::size_t>(std::max_element(score.begin(), score.end()) - score.begin());
  bool leads = true;
  for (std::size_t phase = 0; phase < kWhatFrame_bytes; ++phase) {
    leads = leads && (phase == best || score[best] - score[phase] >= kLead);
  }
  for (std::size_t at = best; leads && at + kWhatFrame_bytes < kWindow_bytes; at += kWhatFrame_bytes) {
    if (bytes_[cursor_ + at] != kStartByte || bytes_[cursor_ + at + kWhatFrame_bytes] != kStartByte) continue;
    cursor_ += at;
    in_step_ = true;
    if (was_in_step_) {
      ++resyncs_;
    } else {
      was_in_step_ = true;
      taken_ = base_ + cursor_;
    }
    return true;
  }
  ++cursor_;
  return true;
}

}  // namespace asperity
