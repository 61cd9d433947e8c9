#pragma once

#include <cstddef>
#include <vector>

#include "asperity/base/config.h"
#include "asperity/recording/calibration.h"
#include "asperity/recording/recording.h"

namespace asperity {

struct OutlierConfig {
  double accel_step_mps2 = 20.0;
  double force_step_N = 1.5;
  int longest_run = 3;

  template <class V>
  void visit(V& v) {
    v.field("accel_step_mps2", accel_step_mps2, "largest step of an axis from one sample to the next, m/s²",
            {0.0, 1e6});
    v.field("force_step_N", force_step_N, "largest step of the force from one sample to the next, N", {0.0, 1e6});
    v.field("longest_run", longest_run, "more samples in a row than this are a change of level, not a spike",
            {0, 1000});
  }
};

struct Outliers {
  std::vector<bool> rejected;  // one a sample
  std::size_t count = 0;
};

// Marks the probe's samples in which any accelerometer axis or the force steps by more than a threshold
// from the last sample kept: spikes of the link (thesis §4.1). The first sample is compared with the
// median of the first few. If more than `longest_run` samples in a row step away, the level has changed
// and they are kept. Counts are compared in physical units by the row norms of the calibration's B;
// cells that are nan are not compared.
Outliers reject_outliers(const ProbeStream& probe, const Calibration& calibration, const OutlierConfig& config);

}  // namespace asperity
