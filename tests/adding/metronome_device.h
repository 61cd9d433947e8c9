#pragma once

#include <memory>

#include "asperity/device/haptic_device.h"

namespace asperity {

struct MetronomeConfig {
  double amplitude_m = 0.01;
  double period_s = 1.0;

  template <class V>
  void visit(V& v) {
    v.field("amplitude_m", amplitude_m, "of its point, m", {0.0, 0.1});
    v.field("period_s", period_s, "of one beat, s", {0.1, 10.0});
  }
};

// A point that goes up and down and does not yield. Throws Error for a config out of range.
std::unique_ptr<HapticDevice> open_metronome(const MetronomeConfig& config);

}  // namespace asperity
