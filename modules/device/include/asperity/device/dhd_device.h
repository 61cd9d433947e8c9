#pragma once

#include <memory>
#include <string>

#include "asperity/device/haptic_device.h"

namespace asperity {

// Force Dimension's devices and the Novint Falcon by the DHD (docs/devices.md).
struct DhdConfig {
  std::string library;            // path of the driver; empty: the system's, then $FDSDK's. Never taken from a scene.
  double rate_Hz = 1000.0;        // at which it wants to be served
  double stall_after_s = 0.02;    // without a new position for so long, the device is stalled
  double watchdog_s = 0.03;       // without a new force for so long, the controller itself turns forces off
  bool without_watchdog = false;  // go on where it cannot: then nothing ends the force of a program that is stopped

  template <class V>
  void visit(V& v) {
    v.field("library", library, "path of the driver; empty: the system's, then $FDSDK's");
    v.field("rate_Hz", rate_Hz, "at which it wants to be served, Hz", {100.0, 4000.0});
    v.field("stall_after_s", stall_after_s, "time without a reading after which the device is stalled, s",
            {0.002, 1.0});
    v.field("watchdog_s", watchdog_s, "time without a new force after which the controller switches forces off, s",
            {0.002, 0.031875});
    v.field("without_watchdog", without_watchdog,
            "use a controller without a watchdog: if this program is stopped or hangs, the last force stays");
  }
};

// Opens the first device, sets its controller's watchdog, and enables its force at zero. Where the driver or the device
// has no watchdog it is not opened, unless `without_watchdog` is set: fault() then says so while the device goes on.
// Its calls are made by the servo thread itself. Its axes (x toward the user, y right, z up) are turned into ours. A
// few calls that fail one after another are kFault; the driver's positive answers (too soon for a new position, motors
// saturated) are not errors. One device a process. Throws Error naming the libraries searched for, or the driver's
// error in its words, or that there is no watchdog.
std::unique_ptr<HapticDevice> open_dhd(const DhdConfig& config);

}  // namespace asperity
