#pragma once

namespace asperity {

// When a probe counts as touching. Two thresholds, and two times for which they must be passed, keep a noisy force
// from opening and closing a segment again and again.
struct TouchConfig {
  double on_N = 0.3;
  double off_N = 0.15;
  double on_noise = 8.0;
  double off_noise = 5.0;
  double idle_s = 0.5;
  double on_hold_s = 0.01;
  double off_hold_s = 0.2;

  template <class V>
  void visit(V& v) {
    v.field("on_N", on_N, "force above which the probe touches, where the force is calibrated, N", {0.0, 100.0});
    v.field("off_N", off_N, "force below which it no longer does, N", {0.0, 100.0});
    v.field("on_noise", on_noise, "the same without a calibration: standard deviations from the idle level",
            {1.0, 1000.0});
    v.field("off_noise", off_noise, "the same without a calibration: standard deviations from the idle level",
            {1.0, 1000.0});
    v.field("idle_s", idle_s, "without a calibration: time at the start from which the idle level is taken, s",
            {0.05, 60.0});
    v.field("on_hold_s", on_hold_s, "time above the upper threshold that makes a touch, s", {0.0, 10.0});
    v.field("off_hold_s", off_hold_s, "time below the lower threshold that ends it, s", {0.0, 10.0});
  }
};

}  // namespace asperity
