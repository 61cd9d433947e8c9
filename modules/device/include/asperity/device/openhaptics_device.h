#pragma once

#include <memory>
#include <string>

#include "asperity/device/haptic_device.h"

namespace asperity {

// Touch, Touch X and Phantom by OpenHaptics' HDAPI (docs/devices.md).
struct OpenHapticsConfig {
  std::string library;            // path of the driver; empty: the system's libHD.so. Never taken from a scene.
  std::string device;             // its name in the vendor's setup; empty: the default one
  double rate_Hz = 1000.0;        // of the vendor's scheduler
  double force_timeout_s = 0.05;  // a force that is not renewed for so long ends
  double stall_after_s = 0.02;    // without a frame of the scheduler for so long, the device is stalled

  template <class V>
  void visit(V& v) {
    v.field("library", library, "path of the driver; empty: the system's libHD.so");
    v.field("device", device, "its name in the vendor's setup; empty: the default one");
    v.field("rate_Hz", rate_Hz, "of the vendor's scheduler, Hz", {500.0, 2000.0});
    v.field("force_timeout_s", force_timeout_s, "a force that is not renewed for so long ends, s", {0.002, 0.1});
    v.field("stall_after_s", stall_after_s, "without news for so long the device is stalled, s", {0.002, 1.0});
  }
};

// Opens the device in a process of its own (asperity_openhaptics), which enables its force with the driver's ramping
// and clamping, and waits for the first frame. The driver's scheduler calls ours there once a frame; forces and
// readings pass through a page that both processes see, without a lock. If this program is killed, stopped or silent,
// that process ends the force; if the driver does not return for 0.1 s, the process is ended, which is a fault. Lost
// communication is kFault; warm motors and exceeded limits are in fault() while the device continues. One device a
// process. Throws Error naming the libraries searched for, or the driver's error in words.
std::unique_ptr<HapticDevice> open_openhaptics(const OpenHapticsConfig& config);

}  // namespace asperity
