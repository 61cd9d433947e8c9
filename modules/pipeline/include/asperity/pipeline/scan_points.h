#pragma once

#include <vector>

#include "asperity/base/progress.h"
#include "asperity/pipeline/measured_path.h"
#include "asperity/pipeline/process_result.h"
#include "asperity/pipeline/register_config.h"
#include "asperity/pipeline/scan.h"
#include "asperity/recording/fingerprint.h"

namespace asperity {

// Where the tips of scans were, as registration wants it; one entry a scan.
struct ScanPoints {
  std::vector<ProcessResult> motions;  // the trajectory and what is doubtful about it; the rest is empty
  std::vector<PathPoints> points;
  std::vector<Fingerprint> fingerprints;  // of what they were measured from
  std::vector<std::size_t> placement;     // the stated number of each scan's placement; empty: not stated
  bool in_sequence = true;                // the points of all scans follow one another, and errors last along them
};

// What a scan was measured from; of a path alone its points are all there is.
Fingerprint fingerprint_of(const Scan& scan);

// The tips' trajectories (seed §4.1 to §4.3) and their points. A path without times is given some: only its sequence
// counts; with steps as long as the whole its points are a cloud, which has none. Throws Error naming the scan, for no
// scan, naming two scans that are not two measurements (check_independent), and Cancelled.
ScanPoints find_scan_points(const std::vector<Scan>& scans, const RegisterConfig& config,
                            const Observer& observer = {});

}  // namespace asperity
