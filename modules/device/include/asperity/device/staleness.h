#pragma once

#include <cstdint>

#include "asperity/device/haptic_device.h"

namespace asperity {

// How long a device has been silent. Begin with Staleness{}.
struct Staleness {
  bool heard = false;  // it was read before
  std::uint64_t sequence = 0;
  double silent_s = 0.0;  // since its last news
};

// One tick of the stale-position watchdog: true if the device has had no news for `stale_after_s` or longer. News is a
// reading with another sequence number that the device does not call stalled. Realtime-safe: yes.
bool is_stale(Staleness& staleness, std::uint64_t sequence, DeviceStatus status, double stale_after_s,
              double dt_s) noexcept;

}  // namespace asperity
