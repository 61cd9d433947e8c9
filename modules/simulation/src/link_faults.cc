#include "link_faults.h"

#include "streams.h"

namespace asperity {

LinkFaults::LinkFaults(double flip_chance, double drop_chance, double insert_chance, std::uint64_t seed)
    : flip_chance_(flip_chance),
      drop_chance_(drop_chance),
      insert_chance_(insert_chance),
      random_(seed, stream(Stream::kLink)) {}

void LinkFaults::carry(std::span<const std::uint8_t> bytes, std::vector<std::uint8_t>& out) {
  for (std::uint8_t byte : bytes) {
    if (insert_chance_ > 0.0 && random_.chance(insert_chance_)) {
      out.push_back(static_cast<std::uint8_t>(random_.bits() & 0xFFU));
      ++inserted_;
    }
    if (drop_chance_ > 0.0 && random_.chance(drop_chance_)) {
      ++dropped_;
      continue;
    }
    if (flip_chance_ > 0.0 && random_.chance(flip_chance_)) {
      byte = static_cast<std::uint8_t>(byte ^ (1U << (random_.bits() & 7U)));
      ++flipped_;
    }
    out.push_back(byte);
  }
}

}  // namespace asperity
