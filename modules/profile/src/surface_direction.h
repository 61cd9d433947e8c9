#pragma once

#include "asperity/base/areal_map.h"

namespace asperity {

struct CorrelationLengths {
  double shortest_m;  // Sal
  double longest_m;   // nan where the autocorrelation stays above 0.2 in some direction, up to half of the map
};

// Of a map of mean zero with some height other than zero. The autocorrelation at a lag is the mean product over the
// pairs of heights that are present, over the mean square; along each direction (every half degree) the first distance
// at which it falls to 0.2 counts (straight lines from the origin, as ISO 25178-2 has it).
CorrelationLengths correlation_lengths(const ArealMap& map);

// Direction of the lay, 0 to π: across that of the maximum of the angular power spectrum, of the map under a Hann
// window with missing heights at the mean.
double lay_direction_rad(const ArealMap& map);

}  // namespace asperity
