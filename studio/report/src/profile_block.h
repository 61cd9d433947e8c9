#pragma once

#include <cstddef>

#include "asperity/profile/profile.h"
#include "asperity/profile/surface_spectrum.h"
#include "asperity/studio/block.h"

namespace asperity::studio {

// The profile, at most `max_points` of it, and the spectrum of its texture: "profile" and "spectrum" of the head and
// their arrays, as in measured_block.h.
void add_profile(const Profile& profile, std::size_t max_points, BlockWriter& block);
void add_spectrum(const SurfaceSpectrum& spectrum, BlockWriter& block);

}  // namespace asperity::studio
