#pragma once

#include <algorithm>
#include <cmath>

#include "asperity/link/probe_decoder.h"
#include "fuzz_input.h"

namespace asperity {

// Any bytes in any pieces: a piece's length and delay come from the input too. Times rise, counts add up.
inline void fuzz_decoder(ProbeProtocol protocol, const std::uint8_t* data, std::size_t size) {
  const auto decoder = make_probe_decoder(protocol);
  std::vector<ProbeSample> samples;
  std::int64_t arrival_ns = 0;
  std::span<const std::uint8_t> rest(data, size);
  std::uint64_t bytes = 0;
  while (rest.size() > 1) {
    const std::uint8_t piece = rest[0];
    rest = rest.subspan(1);
    const auto now = rest.first(std::min<std::size_t>(rest.size(), 1 + 4 * (piece & 0x1FU)));
    arrival_ns += std::int64_t{1} << (10 + 3 * (piece >> 5));
    decoder->push(now, arrival_ns, samples);
    bytes += now.size();
    rest = rest.subspan(now.size());
  }
  const LinkStatistics& statistics = decoder->statistics();
  must(statistics.bytes == bytes);
  must(statistics.samples >= samples.size() && statistics.frames <= bytes / 5);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    must(samples[i].accel_counts.allFinite());
    must(i == 0 || samples[i].t_ns > samples[i - 1].t_ns);
  }
}

}  // namespace asperity
