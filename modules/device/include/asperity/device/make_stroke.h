#pragma once

#include <array>

#include "asperity/device/hand_path.h"

namespace asperity {

// A straight stroke: settle, press, stroke, lift.
struct HandStrokeConfig {
  std::array<double, 3> start_m{0.0, 0.0, 0.0};    // in the device's axes
  std::array<double, 3> direction{1.0, 0.0, 0.0};  // of any length but zero
  double length_m = 0.04;
  double speed_mps = 0.025;
  double press_N = 0.8;
  double ramp_s = 0.2;  // in which the force grows before and falls after
  double rest_s = 0.5;  // pressing at the start and at the end

  template <class V>
  void visit(V& v) {
    v.field("start_m", start_m, "where the stroke begins, in the device's axes, m", {-10.0, 10.0});
    v.field("direction", direction, "in which it runs, in the device's axes; of any length but zero", {-1e6, 1e6});
    v.field("length_m", length_m, "its length, m", {1e-6, 10.0});
    v.field("speed_mps", speed_mps, "its speed, m/s", {1e-4, 10.0});
    v.field("press_N", press_N, "pressing force, N", {0.0, 50.0});
    v.field("ramp_s", ramp_s, "time in which the force grows before and falls after, s", {1e-3, 60.0});
    v.field("rest_s", rest_s, "time pressing at the start and at the end, s", {1e-3, 600.0});
  }
};

// The path of that stroke, from time 0: the force grows over ramp_s at the start, rest_s there, the stroke at constant
// speed, rest_s at its end, and the force falls over ramp_s. Throws Error for a field out of its range or a
// direction that is zero or not finite.
HandPath make_stroke(const HandStrokeConfig& config);

}  // namespace asperity
