#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace asperity {

// A frame of the seed's probe: FFh, three accelerometer bytes, one force byte (seed §3.1).
struct WhatFrame {
  std::array<std::uint8_t, 4> data{};
  std::uint64_t end = 0;      // bytes of the stream up to its last one
  std::uint64_t skipped = 0;  // bytes given up between the frame before and this one
};

// Finds the frames in a stream of bytes among which the start byte may occur as data too.
//
// In step, a frame is taken when the next one's start byte is at its place as well: a byte lost from it or put into it
// would show there. If that start byte alone is missing, and those of the two frames after it are there, it was damaged
// itself: the frame before it is taken, its own is not. Otherwise bytes were lost or came in, and the step is found
// anew: over the next 5 frames' bytes each of the 5 phases gets the likelihood
//
//   Σ over the bytes  log q_c  if the byte is FFh,  log(1 − q_c)  if not,
//
// c its place in the frame by that phase, q_0 = 0.99, q_1…4 how often FFh was seen there of late (from 0.02 to 0.9): a
// sensor at its stop sends FFh in every frame, and is told from the start byte by the bytes beside it. A phase is taken
// if it leads by a factor of e⁶, else the oldest byte is given up. So a frame is found that begins at most 4 bytes
// behind the damage and has 4 clean ones behind it.
class WhatFramer {
 public:
  WhatFramer();

  // Appends the frames that `bytes` complete.
  void push(std::span<const std::uint8_t> bytes, std::vector<WhatFrame>& out);

  std::uint64_t resyncs() const { return resyncs_; }  // times that the step was found, the first one apart
  // Bytes of the stream before the oldest one that may still become part of a frame.
  std::uint64_t settled() const { return base_ + cursor_; }

 private:
  bool step(std::vector<WhatFrame>& out);
  bool looks_odd() const;
  std::array<double, 5> scores() const;
  bool find_phase();
  void take(std::vector<WhatFrame>& out);

  std::vector<std::uint8_t> bytes_;
  std::uint64_t base_ = 0;   // bytes of the stream before bytes_
  std::size_t cursor_ = 0;   // in bytes_: the frame under way, if in step
  std::uint64_t taken_ = 0;  // the stream's bytes up to the last frame's end
  bool in_step_ = false;
  bool was_in_step_ = false;
  std::uint64_t resyncs_ = 0;
  std::array<double, 5> start_rate_{};  // q
};

}  // namespace asperity
