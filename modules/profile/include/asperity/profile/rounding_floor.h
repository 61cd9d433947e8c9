#pragma once

#include <string>

#include "asperity/profile/areal_parameters.h"
#include "asperity/profile/heights_units.h"
#include "asperity/profile/measure_profile_texture.h"
#include "asperity/profile/roughness.h"

namespace asperity {

// Parameters of a texture that is not above the rounding of its numbers are those of the rounding. If the root mean
// square is at most `arithmetic_rms_m`, the numbers are flat: heights and slopes are 0, all other values nan. If it is
// at most `last_digit_rms_m`, which rounding alone can make, all are nan. Returns what was found, as one sentence
// without its end, or "" if the values are left as they are. W is compared only where R is not above: a roughness
// spreads the rounding, so that less of it is in the waviness.
std::string apply_rounding_floor(const HeightsOrigin& origin, RoughnessResult& result);
std::string apply_rounding_floor(const HeightsOrigin& origin, ProfileTexture& texture);
std::string apply_rounding_floor(const HeightsOrigin& origin, ArealParameters& parameters);

}  // namespace asperity
