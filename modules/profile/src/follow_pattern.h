#pragma once

#include <span>

#include "asperity/profile/find_periodicity.h"

namespace asperity {

// find_periodicity() of a pattern whose pitch is known to 3 %, however weak its correlation is: refined, followed by
// its phase, with the depth of its periods.
Periodicity follow_pattern(std::span<const double> height_m, double spacing_m, double pitch_m,
                           const PeriodicityConfig& config);

}  // namespace asperity
