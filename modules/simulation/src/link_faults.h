#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "asperity/base/random.h"

namespace asperity {

// A link that flips a bit of a byte, loses a byte or gains one, each by chance.
class LinkFaults {
 public:
  LinkFaults(double flip_chance, double drop_chance, double insert_chance, std::uint64_t seed);

  // Appends to `out` what arrives of `bytes`.
  void carry(std::span<const std::uint8_t> bytes, std::vector<std::uint8_t>& out);

  std::uint64_t flipped() const { return flipped_; }
  std::uint64_t dropped() const { return dropped_; }
  std::uint64_t inserted() const { return inserted_; }

 private:
  double flip_chance_, drop_chance_, insert_chance_;
  std::uint64_t flipped_ = 0, dropped_ = 0, inserted_ = 0;
  Random random_;
};

}  // namespace asperity
