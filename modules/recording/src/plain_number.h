#pragma once

#include <cmath>
#include <cstdint>

#include "asperity/json/json.h"

namespace asperity {

// Whole numbers without a point, as JsonWriter writes them.
inline Json plain_number(double value) {
  constexpr double kWholeNumbers = 9007199254740992.0;  // 2^53: all whole numbers below are exact
  const bool is_whole = std::abs(value) < kWholeNumbers && value == std::trunc(value);
  if (!is_whole || (value == 0.0 && std::signbit(value))) return value;
  return static_cast<std::int64_t>(value);
}

}  // namespace asperity
