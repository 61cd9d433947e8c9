#pragma once

#include "asperity/recording/recording.h"
#include "asperity/simulation/simulation_config.h"

namespace asperity {

// By how much the recorded rows of the probe are stamped later than they were taken, in the mean, s: what the link and
// its least delay leave, which no host can see and which the latency of the tracker is measured against. The first
// `skip_s` do not count: the host is still learning the probe's clock. `recorded` is what a recorder made of `bench`
// (LiveBench::on_host_clock); its rows are found in the bench's by their counts. Throws Error if they are not.
double stamp_delay_s(const ProbeStream& recorded, const Recording& bench, double skip_s);

// By how much the accelerometer's readings lag the motion: the group delay of its low-pass.
double accelerometer_delay_s(const SimulationConfig& config);

}  // namespace asperity
