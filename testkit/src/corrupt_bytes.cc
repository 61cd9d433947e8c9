#include "asperity/testkit/corrupt_bytes.h"

namespace asperity::testkit {

bool corrupt_bytes(std::span<const std::uint8_t> bytes, const Corruption& corruption, Random& random,
                   std::vector<std::uint8_t>& out) {
  bool damaged = false;
  for (const std::uint8_t byte : bytes) {
    if (random.chance(corruption.insert)) {
      out.push_back(static_cast<std::uint8_t>(random.bits() >> 56));
      damaged = true;
    }
    if (random.chance(corruption.drop)) {
      damaged = true;
      continue;
    }
    const bool flip = random.chance(corruption.flip);
    out.push_back(static_cast<std::uint8_t>(flip ? byte ^ (1U << (random.bits() >> 61)) : byte));
    damaged = damaged || flip;
  }
  return damaged;
}

}  // namespace asperity::testkit
