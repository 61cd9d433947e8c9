#include "what_recording.h"

#include <algorithm>
#include <cmath>

#include "asperity/link/probe_decoder.h"
#include "asperity/simulation/simulate_recording.h"

namespace asperity {

SimulationConfig faultless_what_config(const char* surface, std::uint64_t seed) {
  SimulationConfig config = make_simulation_config(surface, "what");
  config.seed = static_cast<decltype(config.seed)>(seed);
  config.probe.clock_step_s = 0.0;
  config.probe.delivery_delay_s = 0.0;
  config.probe.dropout_chance = 0.0;
  config.probe.spike_chance = 0.0;
  return config;
}

LineResult through_what_line(const Recording& recording, const testkit::WhatLineConfig& line, std::uint64_t seed) {
  const ProbeStream& probe = recording.probe;
  const auto byte_of = [](double counts) {
    return static_cast<std::uint8_t>(std::lround(std::clamp(counts, 0.0, 255.0)));
  };
  std::vector<testkit::WhatSent> sent(probe.size());
  std::uint8_t force = 0;
  for (std::size_t i = 0; i < probe.size(); ++i) {
    if (std::isfinite(probe.force_counts[i])) force = byte_of(probe.force_counts[i]);
    const Eigen::Vector3d& accel = probe.accel_counts[i];
    sent[i] = {probe.t_ns[i], {byte_of(accel.x()), byte_of(accel.y()), byte_of(accel.z()), force}};
  }
  Random random(seed);
  const auto decoder = make_probe_decoder(ProbeProtocol::kWhat);
  std::vector<ProbeSample> samples;
  for (const testkit::ReadBytes& read : testkit::what_line(sent, line, random)) {
    decoder->push(read.bytes, read.arrival_ns, samples);
  }
  LineResult out{recording, decoder->statistics()};
  out.recording.probe = {};
  for (const ProbeSample& sample : samples) {
    out.recording.probe.t_ns.push_back(sample.t_ns);
    out.recording.probe.accel_counts.push_back(sample.accel_counts);
    out.recording.probe.force_counts.push_back(sample.force_counts);
  }
  return out;
}

}  // namespace asperity
