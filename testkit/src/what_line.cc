#include "asperity/testkit/what_line.h"

#include <algorithm>
#include <cmath>

namespace asperity::testkit {

std::vector<ReadBytes> what_line(std::span<const WhatSent> frames, const WhatLineConfig& config, Random& random) {
  constexpr double kByte_ns = 1e9 * 10.0 / 115200.0;
  struct Timed {
    std::int64_t t_ns;
    std::uint8_t byte;
  };
  std::vector<Timed> line;
  line.reserve(5 * frames.size());
  std::vector<std::uint8_t> made;
  for (const WhatSent& frame : frames) {
    const std::array<std::uint8_t, 5> sent{0xFF, frame.data[0], frame.data[1], frame.data[2], frame.data[3]};
    for (std::size_t i = 0; i < sent.size(); ++i) {
      made.clear();
      corrupt_bytes(std::span(sent).subspan(i, 1), config.corruption, random, made);
      const std::int64_t t_ns = frame.t_ns + std::llround(kByte_ns * static_cast<double>(i + 1));
      for (const std::uint8_t byte : made) line.push_back({t_ns, byte});
    }
  }
  std::vector<ReadBytes> reads;
  if (line.empty()) return reads;
  double wakes_ns = static_cast<double>(line.front().t_ns);
  for (std::size_t at = 0; at < line.size();) {
    wakes_ns += 1e9 * config.poll_s;
    double reads_ns = wakes_ns - 1e9 * config.late_s * std::log(1.0 - random.uniform());
    if (random.chance(config.stall_chance)) reads_ns += 1e9 * random.uniform(0.0, config.stall_s);
    wakes_ns = std::max(wakes_ns, reads_ns);
    ReadBytes read;
    read.arrival_ns = std::llround(reads_ns);
    while (at < line.size() && line[at].t_ns <= read.arrival_ns) read.bytes.push_back(line[at++].byte);
    if (!read.bytes.empty()) reads.push_back(std::move(read));
  }
  return reads;
}

}  // namespace asperity::testkit
