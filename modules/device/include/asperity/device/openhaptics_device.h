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
    v.field("force_timeout_s", force_timeout_s, "a force that is not renewed for so long ends, s", {0.002, 1.0});
    v.field("stall_after_s", stall_after_s, "without news for so long the device is stalled, s", {0.002, 1.0});
  }
};

// Opens the device, enables its force with the driver's ramping and clamping, and waits for the first frame. The
// vendor's scheduler thread calls ours once a frame; it takes the newest force and leaves the newest reading, without
// a lock. Lost communication is kFault; warm motors and exceeded limits are in fault() while the device goes on.
// One device a process. Throws Error naming the libraries searched for, or the driver's error in words.
std::unique_ptr<HapticDevice> open_openhaptics(const OpenHapticsConfig& config);

}  // namespace asperity
