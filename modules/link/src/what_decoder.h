#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "asperity/link/device_clock.h"
#include "asperity/link/probe_decoder.h"
#include "what_framer.h"

namespace asperity {

// Reads the frames of the seed's probe and finds their times.
//
// The probe has no clock and no numbers, but an even pace T: that of frame n was sent at the host's time α + β Σ T over
// the frames up to n. n goes on by one from frame to frame, and by the bytes given up between two of them, in frames,
// rounded. A frame's raw time is that of its arrival less the bytes that came with and after it at the byte rate: late,
// never early, so α and β come from DeviceClock with Σ T as the device's time. T is 1/450 s, then, at the 128th
// and the 512th frame, the median pace over stretches of up to 100 frames, which a few lost ones do not move; β stays
// within 15 %, 1 % and 0.3 % of 1. A probe whose pace drifts takes T along when β has left 0.2 %.
//
// Frames that were lost without a byte show in time alone. If the newest frame of what came together is later than the
// line by more than 0.8 T, frames are held back; they are released when one is in time again (they were late), or, if
// none was for 20 ms and eight reads, with n put forward by the least lateness in between (frames were lost). A frame
// that is early by more than 0.25 T had too high a number. After a silence of two seconds all is learned anew.
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
    double device_ns = 0.0;
    std::int64_t raw_ns = 0;
    bool newest = false;  // of what came together
  };
  // A newest frame, to learn the pace from.
  struct Mark {
    std::int64_t count = 0;  // frames, those given up among them, but none put forward
    double device_ns = 0.0;
    std::int64_t raw_ns = 0;
  };

  Timed time_of(const WhatFrame& frame);
  void take(Timed timed, std::vector<ProbeSample>& out);
  void begin_learning();
  void learn(const Timed& timed);
  double median_pace_ns() const;
  void begin_clock(double rate_error);
  void decide(const Timed& timed, std::vector<ProbeSample>& out);
  void put_forward(std::int64_t frames);
  void release(std::vector<ProbeSample>& out);
  void count_lost(std::int64_t number);
  double late_periods(const Timed& timed) const;

  LinkStatistics statistics_;
  WhatFramer framer_;
  std::vector<WhatFrame> frames_;
  std::deque<Piece> pieces_;  // those whose bytes are not all settled
  std::uint64_t received_ = 0;

  DeviceClock clock_;
  double period_ns_ = 0.0;
  std::deque<Mark> marks_;
  std::size_t learned_ = 0;  // frames

  bool has_last_ = false;
  std::int64_t number_ = 0;  // of the last frame
  std::int64_t count_ = 0;
  double device_ns_ = 0.0;
  std::int64_t last_raw_ns_ = 0;
  std::int64_t given_ = 0;  // frames

  std::vector<Timed> held_;
  std::int64_t held_since_ns_ = 0;
  int held_late_ = 0;        // newest ones among held_
  double least_late_ = 0.0;  // of these, in periods
  double last_late_ = 0.0;
};

}  // namespace asperity
