#pragma once

#include <array>
#include <string_view>

namespace asperity {

// How the object moves under the scan: not at all, held in the other hand, or rotated in it as well.
enum class SimulatedObjectMotion { kNone, kHeld, kTurned };
inline constexpr std::array<std::string_view, 3> kSimulatedObjectMotionNames = {"none", "held", "turned"};

struct SimulatedObjectConfig {
  SimulatedObjectMotion motion = SimulatedObjectMotion::kNone;
  double drift_m = 4e-3;  // of each axis, rms
  double drift_rad = 0.05;
  double drift_Hz = 0.6;    // its highest frequency
  double tremor_m = 20e-6;  // of each axis, rms: a hand that rests on the table has a tenth of a raised one's
  double tremor_rad = 0.4e-3;
  double tremor_low_Hz = 6.0;
  double tremor_high_Hz = 11.0;
  std::array<double, 3> turn_rad{0.2, 0.6, 0.3};  // turned: rotation vector over the whole recording, world axes
  std::array<double, 3> body_m{0.0, 0.035,
                               0.0};  // the body's origin from the middle of the stroke, world axes, at first

  template <class V>
  void visit(V& v) {
    v.choice("motion", motion, kSimulatedObjectMotionNames,
             "how the object moves: not at all, held in a hand, or rotated in it as well");
    v.field("drift_m", drift_m, "held, turned: drift of each axis, m rms", {0.0, 0.1});
    v.field("drift_rad", drift_rad, "held, turned: drift of the rotation about each axis, rad rms", {0.0, 1.0});
    v.field("drift_Hz", drift_Hz, "highest frequency of the drift, Hz", {0.06, 3.0});
    v.field("tremor_m", tremor_m, "held, turned: tremor of each axis, m rms", {0.0, 0.01});
    v.field("tremor_rad", tremor_rad, "held, turned: tremor of the rotation about each axis, rad rms", {0.0, 0.1});
    v.field("tremor_low_Hz", tremor_low_Hz, "lower end of the tremor's band, Hz", {0.5, 50.0});
    v.field("tremor_high_Hz", tremor_high_Hz, "upper end of the tremor's band, Hz", {0.5, 50.0});
    v.field("turn_rad", turn_rad, "turned: rotation vector over the recording, world axes, rad", {-3.0, 3.0});
    v.field("body_m", body_m, "origin of the object's marker body from the middle of the stroke, m", {-1.0, 1.0});
  }
};

}  // namespace asperity
