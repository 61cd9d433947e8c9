#pragma once

#include <functional>
#include <vector>

#include "asperity/batch/run_scan.h"

namespace asperity {

// run_scan for each of `scans`, `jobs` of them at a time, in their order; the outcomes are in that order too. A scan
// for which Error is thrown counts as failed with its message, and the others continue. `ended` is called after each,
// never by two threads at once. Throws Cancelled when all running steps have been stopped.
std::vector<ScanOutcome> run_batch(const BatchPlan& plan, const std::vector<BatchScan>& scans,
                                   const std::string& output, const std::filesystem::path& program, int jobs,
                                   const Observer& observer, const std::function<void(const ScanOutcome&)>& ended);

}  // namespace asperity
