#pragma once

#include <span>

#include "asperity/profile/find_periodicity.h"

namespace asperity {

// find_repetition() of a pattern whose pitch is known to 3 %, in heights less their mean over one period, twice: waves
// that are longer than the pattern, as a tremor's, do not count.
Periodicity follow_pattern(std::span<const double> height_m, double spacing_m, double pitch_m,
                           const PeriodicityConfig& config);

// The same of the strongest repetition by the autocorrelation, whether or not it has a line: `periodic` is strength and
// number of periods alone.
Periodicity find_repetition(std::span<const double> height_m, double spacing_m, const PeriodicityConfig& config);

}  // namespace asperity
