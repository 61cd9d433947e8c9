#pragma once

#include "asperity/verdict/judge_scan.h"

namespace asperity {

// Whether the calibration fits the recording: units, frames, range and band of the accelerometer, the latency, and
// whether tracker and inertial sensors show the same motion.
void judge_calibration(const ScanEvidence& evidence, Verdicts& out);

// Whether the streams are whole: the tracker's noise, gaps and repeats, lost rows, spikes.
void judge_streams(const ScanEvidence& evidence, Verdicts& out);

}  // namespace asperity
