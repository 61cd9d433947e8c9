#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "asperity/base/progress.h"

namespace asperity {

// The zero-phase second-order Butterworth high-pass of a uniform profile (seed §5.2, errata 12 and 13):
// -3 dB of the whole filter at `cutoff_cycles_per_mm`, of each run less its least-squares parabola (its line, if it is
// shorter than a wave of the cut-off); 0 gives the heights less the mean of each run. Gaps
// (nan) up to bridge_m are bridged by straight lines for the filter and marked again after it; wider ones,
// and the places in `breaks` (indices at which a new run begins), separate runs that are filtered each
// for itself. A run of fewer than 8 points is nan. Throws Error for a spacing or a cut-off out of range; Cancelled
// between the steps of a run's filter.
std::vector<double> extract_texture(std::span<const double> height_m, double spacing_m, double cutoff_cycles_per_mm,
                                    double bridge_m, std::span<const std::size_t> breaks = {},
                                    const Observer& observer = {});

}  // namespace asperity
