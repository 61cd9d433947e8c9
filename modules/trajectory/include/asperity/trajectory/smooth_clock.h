#pragma once

#include <cstdint>
#include <vector>

namespace asperity {

struct SmoothClockConfig {
  double window_s = 0.5;  // of the local straight line through the time stamps

  template <class V>
  void visit(V& v) {
    v.field("window_s", window_s, "window of the local straight line through the time stamps, s", {0.01, 60.0});
  }
};

struct SmoothClockResult {
  std::vector<std::int64_t> t_ns;  // strictly rising
  double period_s = 0.0;           // of the device
  double jitter_s = 0.0;           // RMS of the correction
  bool applied = false;            // false: the stamps were kept, being regular already or not from a regular device
};

// Removes the jitter of time stamps given on arrival to samples that a device took at a regular rate.
// The period is the one at which the stamps keep their phase; the count of periods between two samples (lost ones
// included) is the one nearest to all stamps (sample_clock.h). Each new stamp is the value of the least-squares line of
// stamp over count in a window around it. `t_ns` rises strictly. Stamps with an RMS of 0.26 periods and more are taken
// as batches if 60 % of the steps are one period: each sample is then one period after the one before, unless what
// follows a gap stays late (samples were lost). Others have no regular clock behind them and are kept as they are.
SmoothClockResult smooth_clock(const std::vector<std::int64_t>& t_ns, const SmoothClockConfig& config);

}  // namespace asperity
