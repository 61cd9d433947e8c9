#pragma once

#include <limits>

namespace asperity {

// The value where there is no number: a gap in a profile, a pose that was not seen.
inline constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

}  // namespace asperity
