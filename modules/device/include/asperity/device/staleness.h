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

// What is remembered of silences that are over. Begin with Stammer{}.
struct Stammer {
  bool stale = false;          // at the tick before
  double since_onset_s = 1e9;  // of the last silence
  double hold_s = 0.0;         // the force is held at zero for so long yet
};

// One tick of a device that falls silent again and again, as one whose answers come late: true while its force is to be
// zero, which is for kStammerHold_s from the last of at least two silences that began within kStammerWindow_s. Without
// it the force would resume softly after each of them, against the hand's old position. Realtime-safe: yes.
inline constexpr double kStammerWindow_s = 1.0;
inline constexpr double kStammerHold_s = 0.25;
bool is_stammering(Stammer& stammer, bool stale, double dt_s) noexcept;

}  // namespace asperity
