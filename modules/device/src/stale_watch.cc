#include "asperity/device/stale_watch.h"

namespace asperity {

bool is_stale(StaleWatch& watch, std::uint64_t sequence, DeviceStatus status, double stale_after_s,
              double dt_s) noexcept {
  const bool news = (!watch.heard || sequence != watch.sequence) && status != DeviceStatus::kStalled;
  watch.silent_s = news ? 0.0 : watch.silent_s + dt_s;
  if (news) {
    watch.heard = true;
    watch.sequence = sequence;
  }
  // Half a tick of slack: a sum of ticks is not exactly a time.
  return watch.silent_s + 0.5 * dt_s >= stale_after_s;
}

}  // namespace asperity
