#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "asperity_firmware/probe.h"
#include "fake_board.h"
#include "reference_decoder.h"

namespace asperity {

asp_description description_of(bool gyro, bool force3);

// A probe on a fake board.
class ProbeRig {
 public:
  ProbeRig(const FakeBoard::Options& options, bool gyro, bool force3,
           const asp_probe_config& config = asp_default_config);

  // A turn each `step_us`.
  void run_us(std::uint64_t us, std::uint64_t step_us);

  // What the host has received.
  reference::Decoded decoded() const { return reference::decode(board.received()); }

  FakeBoard board;
  std::unique_ptr<asp_probe> probe;
};

struct Account {
  std::uint64_t rows = 0;
  std::uint64_t rows_missing = 0;
  std::uint64_t forces = 0;
  std::uint64_t forces_missing = 0;
  std::uint64_t next_row = 0;  // number after the last one
  std::uint64_t next_force = 0;
  int overruns = 0;
  int needless_overruns = 0;  // of frames before which no row is missing: of force samples
};

// Expects that every sample of every frame is the one that the sensor made, at its time, in order, and that every gap
// is told by imu_index and `overrun`. Times are cut to whole µs, and a period is rounded to whole ns.
Account check_samples(const ProbeRig& rig, const std::vector<reference::SampleFrame>& frames,
                      std::uint32_t first_sequence = 0, std::uint32_t first_index = 0, double time_tol_ns = 1100.0);

}  // namespace asperity
