#pragma once

#include <memory>
#include <string>

#include "asperity/device/haptic_device.h"

namespace asperity {

struct HaplyConfig {
  std::string host = "localhost";
  int port = 10001;
  std::string device_id;        // as in the service's inventory; empty: the first
  std::string axes = "XZ-Y";    // which of the service's axes our x, y, z are
  double max_rate_Hz = 4000.0;  // messages to the service
  double open_timeout_s = 3.0;
  double force_timeout_s = 0.05;  // a force older than this is not sent again: zero is
  double late_after_s = 0.01;     // a state this old is not new
  double stall_after_s = 0.02;
  double lost_after_s = 2.0;
  template <class V>
  void visit(V& v) {
    v.field("host", host, "where the Inverse Service runs");
    v.field("port", port, "its WebSocket and HTTP port", {1, 65535});
    v.field("device_id", device_id, "device as in the inventory; empty: the first");
    v.field("axes", axes, "service axes that are right, up and toward the user, with signs");
    v.field("max_rate_Hz", max_rate_Hz, "most messages a second to the service, Hz", {10.0, 20000.0});
    v.field("open_timeout_s", open_timeout_s, "for connecting and the first state, s", {0.01, 60.0});
    v.field("force_timeout_s", force_timeout_s, "older forces become zero, s", {0.001, 1.0});
    v.field("late_after_s", late_after_s, "a later state is not used, s", {0.001, 1.0});
    v.field("stall_after_s", stall_after_s, "without a state: stalled, s", {0.001, 1.0});
    v.field("lost_after_s", lost_after_s, "without a state: a fault, s", {0.01, 60.0});
  }
};

// A Haply Inverse3 by way of its Inverse Service (3.1 and later of the 3 series): JSON over a WebSocket, on a thread
// of the device's own. Each state from the service is answered by one message with the newest force, at no more than
// `max_rate_Hz`; read() and write() exchange plain values with that thread, without lock or system call.
//
// Axes: the service's default basis is x right, y forward, z up (right-handed, docs.haply.co "Basis Permutation");
// ours are right, up, toward the user, hence "XZ-Y". A session whose basis was changed in Haply Hub needs other
// `axes`. `info().workspace_*`, forces and stiffness stay nan: the service states none.
//
// kStalled after `stall_after_s` without a state. kFault, for good: connection closed, device gone from the state,
// malformed frame, `lost_after_s` without a state. There is no reconnection: where the hand went meanwhile is not
// known; open again instead. close() sends a zero force and closes the WebSocket, within half a second.
// Throws Error: config out of range, no service, unknown version, no such device, no state in `open_timeout_s`.
std::unique_ptr<HapticDevice> open_haply(const HaplyConfig& config);

}  // namespace asperity
