#pragma once

#include "asperity/base/config.h"
#include "asperity/base/nan.h"

namespace asperity {

// The probe whose tip is led over a rendered surface, where the recording does not state it. The bandwidths are those
// of the open probe (docs/virtual-bench.md).
struct VirtualProbeConfig {
  double mass_kg = 0.0;
  double hand_damping_N_s_per_m = 4.0;
  double hand_stiffness_N_per_m = 300.0;
  double contact_damping_ratio = 0.15;
  double accel_bandwidth_Hz = 1000.0;
  double force_bandwidth_Hz = 100.0;

  template <class V>
  void visit(V& v) {
    v.field("mass_kg", mass_kg, "of probe and hand along the normal, kg; 0: from the held-back stroke's own signals",
            {0.0, 10.0});
    v.field("hand_damping_N_s_per_m", hand_damping_N_s_per_m, "of the hand, where mass_kg is given or not determined",
            {0.0, 1e4});
    v.field("hand_stiffness_N_per_m", hand_stiffness_N_per_m, "likewise, N/m", {0.0, 1e6});
    v.field("contact_damping_ratio", contact_damping_ratio, "of the probe on the contact's spring", {0.0, 2.0});
    v.field("accel_bandwidth_Hz", accel_bandwidth_Hz,
            "-3 dB of the accelerometer, second-order Butterworth; 0: passes all", {0.0, 1e6});
    v.field("force_bandwidth_Hz", force_bandwidth_Hz, "-3 dB of the force sensor, one pole; 0: passes all", {0.0, 1e6});
  }
};

// What the hand opposes to a motion of the tip along the normal: mass, damping, spring.
struct HandImpedance {
  double mass_kg = 0.04;
  double damping_N_s_per_m = 4.0;
  double stiffness_N_per_m = 300.0;
  double mass_sigma_kg = kNan;  // its standard error; nan: not estimated
  double explained = kNan;      // part of the reading's power in the band that it explains
  bool measured = false;        // from the stroke's signals; else assumed
};

}  // namespace asperity
