#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "asperity/recording/recording.h"
#include "asperity/simulation/probe_config.h"

namespace asperity {

// The probe's own clock: it starts anywhere and runs a little too fast or slow.
struct ProbeClock {
  double start_s = 37.25;  // what it shows at the recording's first sample
  double fast_ppm = 35.0;  // a crystal's
};

// A probe that sends the samples of a recording in its protocol's bytes, as time goes on. `open` is the firmware's own
// core (firmware/core) on a board whose sensors and clock are simulated; `what` is five bytes a sample, FFh first.
// Not thread-safe.
class ProbeDevice {
 public:
  virtual ~ProbeDevice() = default;

  // Advances the time to `t_ns` on the recording's clock, and appends what the probe sends by then to `out`. At most 64
  // ms at once, or the firmware's queue is too short. Time does not go back.
  virtual void advance(std::int64_t t_ns, std::vector<std::uint8_t>& out) = 0;

  // Bytes from the host.
  virtual void receive(std::span<const std::uint8_t> bytes) = 0;
};

// `recording` needs its truth: samples are taken at its times, one for each row, so that nothing of it may have been
// lost (without_link_faults). Throws Error if that is not so. Copies what it needs.
std::unique_ptr<ProbeDevice> make_probe_device(const Recording& recording, const SimulatedProbeConfig& config,
                                               const ProbeClock& clock = {});

// What arrives together at the host.
struct ProbeBytes {
  std::int64_t t_ns = 0;  // on the recording's clock
  std::vector<std::uint8_t> bytes;
};

// All that the probe sends of a recording, read by a host every `poll_s` without any delay. For calibration data that
// need not be paced.
std::vector<ProbeBytes> send_recording(const Recording& recording, const SimulatedProbeConfig& config,
                                       const ProbeClock& clock = {}, double poll_s = 1e-3);

}  // namespace asperity
