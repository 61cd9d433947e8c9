#pragma once

#include <span>
#include <string>

#include "asperity/profile/profile_pass.h"
#include "process_stages.h"

namespace asperity {

// Points first to last − 1 of a profile as a pass. `texture_m` is the profile's before noise was removed.
ProfilePass profile_pass(std::string name, const Profile& profile, std::span<const double> texture_m,
                         const TextureNoise& noise, std::size_t first, std::size_t last);

// The strokes of a recording that goes back and forth: runs of at least 10 mm along the path's longest axis. Two or
// more are merged (merge_passes.h) and take the place of the profile, its arc length that of the first stroke, if they
// agree. Without them nothing changes.
void merge_recorded_passes(const BasePathResult& base, MeasuredProfile& measured);

}  // namespace asperity
