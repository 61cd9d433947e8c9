#pragma once

#include <span>

#include "asperity/profile/profile.h"

namespace asperity {

// Whether a line of a profile's spectrum is of the path or of the time. A surface's pattern is a line over the path; a
// hand changes its speed, and over time it is smeared. Hum of the mains, a motor or a resonance are lines over time,
// and smeared over the path.
//
// Of `height_m` (one for each point of `profile`, nan in gaps; m) the strongest of the pattern's first eight harmonics
// is taken, and the highest ordinate of the same heights over the times at which the tip passed them, at the
// frequencies that this wave has at the speeds between the 5th and the 95th percentile. Returned is the power of the
// second over that of the first: near 1 at a constant speed, where the two cannot be told apart, above it for a line of
// the time. nan without speeds or without a pitch.
double line_over_time(const Profile& profile, std::span<const double> height_m, double pitch_m);

}  // namespace asperity
