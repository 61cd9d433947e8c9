#pragma once

#include <memory>

#include "asperity/device/hand_model_config.h"
#include "asperity/device/hand_path.h"
#include "asperity/device/haptic_device.h"
#include "asperity/device/make_stroke.h"

namespace asperity {

// The device whose hand is computed. Its limits are generous: they stand for no product.
struct SimDeviceConfig {
  HandModelConfig hand;
  HandStrokeConfig stroke;
  double max_force_N = 20.0;  // its motors give no more
  double max_stiffness_N_per_m = 5000.0;
  double bandwidth_Hz = 1000.0;
  double rate_Hz = 1000.0;

  template <class V>
  void visit(V& v) {
    v.group("hand", hand);
    v.group("stroke", stroke);
    v.field("max_force_N", max_force_N, "force of the motors, N", {0.1, 1000.0});
    v.field("max_stiffness_N_per_m", max_stiffness_N_per_m, "stiffest wall it claims to render, N/m", {1.0, 1e6});
    v.field("bandwidth_Hz", bandwidth_Hz, "up to which it claims to render textures faithfully, Hz", {1.0, 1e5});
    v.field("rate_Hz", rate_Hz, "at which it wants to be served, Hz", {100.0, 4000.0});
  }
};

// A hand pulled along `path` (simulated_hand.h), whose first point is at the schedule's time 0; deterministic. The
// force written at one tick acts until the next; beyond max_force_N it is shortened, a non-finite one is none.
// Readings after the path's last point are kEnded. Throws Error for a config or path out of its bounds.
std::unique_ptr<HapticDevice> open_sim(const SimDeviceConfig& config, HandPath path);

// The same with the stroke of the config.
std::unique_ptr<HapticDevice> open_sim(const SimDeviceConfig& config);

}  // namespace asperity
