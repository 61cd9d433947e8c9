#include "asperity/device/staleness.h"

namespace asperity {

bool is_stale(Staleness& staleness, std::uint64_t sequence, DeviceStatus status, double stale_after_s,
              double dt_s) noexcept {
  const bool news = (!staleness.heard || sequence != staleness.sequence) && status != DeviceStatus::kStalled;
  staleness.silent_s = news ? 0.0 : staleness.silent_s + dt_s;
  if (news) {
    staleness.heard = true;
    staleness.sequence = sequence;
  }
  // Half a tick of slack: a sum of ticks is not exactly a time.
  return staleness.silent_s + 0.5 * dt_s >= stale_after_s;
}

bool is_stammering(Stammer& stammer, bool stale, double dt_s) noexcept {
  stammer.since_onset_s += dt_s;
  stammer.hold_s -= dt_s;
  if (stale && !stammer.stale) {
    if (stammer.since_onset_s < kStammerWindow_s) stammer.hold_s = kStammerHold_s;
    stammer.since_onset_s = 0.0;
  }
  stammer.stale = stale;
  return stammer.hold_s > 0.0;
}

}  // namespace asperity
