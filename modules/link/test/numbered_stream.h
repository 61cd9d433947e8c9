#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "asperity/link/probe_decoder.h"

namespace asperity::testkit {

// Frames of the open protocol whose rows carry their own number, so that a row that was never sent is known.
struct NumberedStream {
  std::vector<std::uint8_t> bytes;
  std::vector<std::uint32_t> first_row;  // of each frame, and the number of rows
};

// `frames` frames of one to eight rows at 4 kHz with gyroscope, every other one with a force sample.
NumberedStream numbered_stream(std::uint32_t frames, std::uint64_t seed);

// What was received against what was sent, between the first and the last row received.
struct StreamTruth {
  std::uint64_t false_rows = 0;  // never sent, or out of their order
  std::uint64_t frames = 0;
  std::uint64_t missing_rows = 0;
  std::uint64_t missing_frames = 0;
};

StreamTruth compare_with_sent(const NumberedStream& sent, std::span<const ProbeSample> received);

}  // namespace asperity::testkit
