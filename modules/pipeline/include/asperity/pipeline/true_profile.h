#pragma once

#include "asperity/profile/make_profile.h"
#include "asperity/profile/profile.h"
#include "asperity/recording/recording.h"

namespace asperity {

// The profile that a measurement without error would give: the truth's heights over its arc length, resampled
// and high-pass filtered exactly as make_profile does. Of the profile only s_m, height_m and texture_m are
// filled. Throws Error if the truth has fewer than 8 heights.
Profile true_profile(const Truth& truth, const ProfileConfig& config);

}  // namespace asperity
