#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "asperity/base/random.h"

namespace asperity::testkit {

// How often a byte of a link is damaged.
struct Corruption {
  double flip = 0.0;    // one of its bits is inverted
  double drop = 0.0;    // it is lost
  double insert = 0.0;  // a random byte comes before it
};

// Appends to `out` what a link makes of `bytes`; true if it did anything to them.
bool corrupt_bytes(std::span<const std::uint8_t> bytes, const Corruption& corruption, Random& random,
                   std::vector<std::uint8_t>& out);

}  // namespace asperity::testkit
