#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "asperity/acquire/device_clock.h"
#include "asperity/acquire/probe_decoder.h"
#include "what_framer.h"

namespace asperity {

// Reads the frames of the seed's probe and finds their times.
//
// The probe has no clock and no numbers, but an even pace: frame n was sent at α + n T. n goes on by one from frame to
// frame, and by the bytes given up between two of them, in frames, rounded. A frame's raw time is that of its arrival
// less the bytes that came with and after it at the byte rate: late, never early, so the line comes from DeviceClock
// with n T as the device's time. T is the median of the pace over stretches of 20 frames among the first 128 (before,
// frames are taken to come at 450 Hz, give or take 15 %), and then what the line's slope makes of it.
//
// Frames that were lost without a byte show in time alone. If the newest frame of what came together is later than the
// line by more than 0.6 T, frames are held back; they are released when one is in time again (they were late), or, if
// none was for 20 ms, with n put forward by the least lateness in between (they were lost). A frame that is early by
// more than 0.6 T had too high a number. After a silence of two seconds the pace is learned anew.
class WhatDecoder : public ProbeDecoder {
 public:
  WhatDecoder();
  void push(std::span<const std::uint8_t> bytes, std::int64_t arrival_ns, std::vector<ProbeSample>& out) override;
  const LinkStatistics& statistics() const override { return statistics_; }
  std::optional<ProbeDescription> description() const override { return std::nullopt; }

 private:
  struct Piece {
    std::uint64_t end = 0;  // the stream's bytes up to its last one
    std::int64_t arrival_ns = 0;
  };
  struct Timed {
    WhatFrame frame;
    std::int64_t number = 0;
    std::int64_t raw_ns = 0;
    bool newest = false;  // of what came together
  };

  Timed time_of(const WhatFrame& frame);
  void take(Timed timed, std::vector<ProbeSample>& out);
  void number_frame(Timed& timed);
  void learn(const Timed& timed);
  void settle_pace();
  void decide(const Timed& timed, std::vector<ProbeSample>& out);
  void put_forward(std::int64_t frames);
  void release(std::vector<ProbeSample>& out);
  void count_lost(std::int64_t number);
  double late_periods(const Timed& timed) const;
  std::int64_t device_ns(std::int64_t number) const;

  LinkStatistics statistics_;
  WhatFramer framer_;
  std::vector<WhatFrame> frames_;
  std::deque<Piece> pieces_;  // those whose bytes are not all settled
  std::uint64_t received_ = 0;

  DeviceClock clock_;
  double period_ns_ = 0.0;
  bool pace_known_ = false;
  std::vector<Timed> learned_;  // the newest of what came together, while the pace is not known
  std::size_t seen_ = 0;        // frames since learning began

  bool has_last_ = false;
  std::int64_t last_number_ = 0;
  std::int64_t last_raw_ns_ = 0;
  std::int64_t given_ = 0;  // frames

  std::vector<Timed> held_;
  std::int64_t held_since_ns_ = 0;
  int held_late_ = 0;        // newest ones among held_
  double least_late_ = 0.0;  // of these, in periods
  double last_late_ = 0.0;
};

}  // namespace asperity
