#pragma once

#include <limits>
#include <string>

#include "asperity/device/haptic_device.h"
#include "asperity/device/servo_loop.h"

namespace asperity {

// What is supposed where nobody states it.
struct DeviceCapsConfig {
  double texture_stiffness_N_per_m_kHz = 450;  // stable texture stiffness for each kHz of the rate
  double stroke_mps = 0.1;                     // at which textures are to be rendered faithfully

  template <class V>
  void visit(V& v) {
    v.field("texture_stiffness_N_per_m_kHz", texture_stiffness_N_per_m_kHz,
            "stable texture stiffness for each kHz of the rate", {1.0, 1e6});
    v.field("stroke_mps", stroke_mps, "speed at which textures are to be faithful", {1e-4, 10.0});
  }
};

// What of a scene a device can render, in the scene's units. Infinite where nothing is known.
struct DeviceCaps {
  static constexpr double kNone = std::numeric_limits<double>::infinity();

  double force_N = kNone;
  double stiffness_N_per_m = kNone;
  std::string stiffness_reason;  // in words, what sets it
  double texture_stiffness_N_per_m = kNone;
  std::string texture_stiffness_reason;
  double texture_cycles_per_mm = kNone;
  std::string texture_bandwidth_reason;
};

// The caps of a device under the loop of `servo`, with r the smaller of the loop's rate and the device's, and s the
// frame's scale: a metre of the hand is s metres of the scene, so the hand feels s times the scene's stiffness and s
// times its spatial frequencies.
//   force               the smaller of max_force_N of the safety layer and of the device
//   stiffness           the largest that the device states, in proportion if it is served more slowly than it wants; if
//                       it states none, 2 b r with b = assumed_damping_N_s_per_m: a sampled spring needs the physical
//                       damping b > k T/2 (Colgate and Brown 1994). Over s
//   texture stiffness   0.45 N/mm at 1 kHz (Choi, Tan 2004, thesis §2.3), in proportion to r as k T/2 is, over s; and
//                       the cap on stiffness
//   texture cycles      f = v · cycles: the device's bandwidth, r/2 at most, at the hand's speed stroke_mps (Campion
//   and
//                       Hayward 2005), over s; no cap for a device that states no bandwidth
DeviceCaps find_device_caps(const DeviceInfo& info, const ServoConfig& servo, const DeviceCapsConfig& config);

}  // namespace asperity
