#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "asperity/base/random.h"
#include "asperity/testkit/corrupt_bytes.h"

namespace asperity::testkit {

// A frame of the seed's probe as it is sent.
struct WhatSent {
  std::int64_t t_ns = 0;  // of its start byte's beginning
  std::array<std::uint8_t, 4> data{};
};

// Bytes that a host got with one read.
struct ReadBytes {
  std::vector<std::uint8_t> bytes;
  std::int64_t arrival_ns = 0;
};

struct WhatLineConfig {
  Corruption corruption;
  double poll_s = 1e-3;       // between two reads of the host
  double late_s = 0.2e-3;     // mean of an exponential delay of each
  double stall_chance = 0.0;  // that a read waits for up to stall_s
  double stall_s = 0.1;
};

// What a host reads when `frames`, in the order of their times, are sent at 115,200 bps, 8N1.
std::vector<ReadBytes> what_line(std::span<const WhatSent> frames, const WhatLineConfig& config, Random& random);

}  // namespace asperity::testkit
