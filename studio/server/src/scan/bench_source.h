#pragma once

#include <memory>

#include "asperity/base/progress.h"
#include "scan/bench_config.h"
#include "scan/scan_source.h"

namespace asperity::studio {

// The virtual bench as hardware (docs/live-bench.md): simulates the scan, and plays it over a pseudo-terminal and a
// FIFO at each start. Before the first time it plays its first static interval, in which the probe describes
// itself. Takes some seconds. Throws Error for what cannot be simulated, and Cancelled.
std::unique_ptr<ScanSource> make_bench_source(const BenchConfig& config, const Observer& observer);

}  // namespace asperity::studio
