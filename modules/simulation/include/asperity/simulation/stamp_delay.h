#pragma once

#include "asperity/recording/recording.h"
#include "asperity/simulation/simulation_config.h"

namespace asperity {

// By how much the recorded rows of the probe are stamped later than they were taken, the median, s (the first rows may
// come late before the host knows the probe's clock): what the link and
// its least delay leave, which no host can see and which the latency of the tracker is measured against. `recorded` is
// what a recorder made of `bench` (LiveBench::on_host_clock); its rows are found in the bench's by their counts. Throws
// Error if they are not.
double stamp_delay_s(const ProbeStream& recorded, const Recording& bench);

// By how much the gyroscope's readings lag the motion: the group delay of its low-pass.
double gyroscope_delay_s(const SimulationConfig& config);

}  // namespace asperity
