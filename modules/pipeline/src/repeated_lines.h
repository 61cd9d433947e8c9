#pragma once

#include <span>
#include <string>

#include "asperity/pipeline/process_result.h"
#include "asperity/profile/profile_pass.h"
#include "process_stages.h"
#include "shared_lines.h"

namespace asperity {

// Points first to last − 1 of a profile as a pass. `texture_m` is the profile's before noise was removed.
ProfilePass profile_pass(std::string name, const Profile& profile, std::span<const double> texture_m,
                         const TextureNoise& noise, std::size_t first, std::size_t last);

// The base path's point under each point of a profile.
std::vector<Eigen::Vector3d> points_under_profile(const BasePath& path, const Profile& profile);

// Merges the passes over a line (merge_passes.h) and puts the merge in their place in the profiles (lay_merge.h), where
// they agree and their lines differ by less than half of the power of their noise: beyond 1 each is nearer to its own
// line than the merge is. `measured[k]` and `names[k]` are those of the line's scan k; no noise
// was removed from the profiles.
RepeatedLine merge_line(const SharedLine& line, std::span<MeasuredProfile* const> measured,
                        std::span<const std::string> names);

// The lines that the path of one recording is over more than once, merged.
void merge_recorded_lines(const BasePathResult& base, MeasuredProfile& measured);

}  // namespace asperity
