#pragma once

#include <cstdint>
#include <optional>

#include "asperity/studio/hub.h"

namespace asperity::studio {

// Who may command forces: one browser at a time, as long as its heartbeats come (docs/studio-safety.md). Times are in
// nanoseconds of a monotonic clock. Pure: no clock of its own. On the studio's thread alone.
class ForceLease {
 public:
  static constexpr std::int64_t kSilence_ns = 500'000'000;  // heartbeats come five times as often

  // True if `client` has it then; a living owner keeps it.
  bool acquire(ClientId client, std::int64_t now_ns);
  // A sign of life of the owner; ignored from others.
  void heartbeat(ClientId client, std::int64_t now_ns);
  void release(ClientId client);

  // The owner, unless it has been silent for longer than kSilence_ns.
  std::optional<ClientId> owner(std::int64_t now_ns) const;

 private:
  std::optional<ClientId> owner_;
  std::int64_t last_ns_ = 0;
};

}  // namespace asperity::studio
