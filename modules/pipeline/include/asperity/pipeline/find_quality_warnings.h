#pragma once

#include <string>
#include <vector>

#include "asperity/recording/recording.h"
#include "asperity/trajectory/trajectory_result.h"

namespace asperity {

// Why a trajectory should not be trusted, a sentence each for a person; empty if nothing speaks against it.
// Physics and the calibration's own word are the judges: the specific force of a hand-held probe is
// gravity on the average; an estimated bias, latency or tracker noise far from its prior means a wrong
// frame, sign, unit or clock; poses that repeat or disagree, samples that were dropped or clipped, and streams
// that hardly overlap are not a measurement.
std::vector<std::string> find_quality_warnings(const Recording& recording, const TrajectoryResult& trajectory);

}  // namespace asperity
