#include "asperity/studio/force_lease.h"

namespace asperity::studio {

bool ForceLease::acquire(ClientId client, std::int64_t now_ns) {
  const std::optional<ClientId> living = owner(now_ns);
  if (living && *living != client) return false;
  owner_ = client;
  last_ns_ = now_ns;
  return true;
}

void ForceLease::heartbeat(ClientId client, std::int64_t now_ns) {
  if (owner(now_ns) == client) last_ns_ = now_ns;
}

void ForceLease::release(ClientId client) {
  if (owner_ == client) owner_.reset();
}

std::optional<ClientId> ForceLease::owner(std::int64_t now_ns) const {
  return owner_ && now_ns - last_ns_ <= kSilence_ns ? owner_ : std::nullopt;
}

}  // namespace asperity::studio
