#pragma once

#include "match_points.h"

namespace asperity::registration {

// Throws Error if the surface was not prepared from its mesh.
void check_surface(const RegistrationSurface& surface);

MatchRules match_rules(const RegistrationConfig& config);

// The same where poses are weighed: without the rule about the probe's directions where some are not known.
MatchRules weighing_rules(const PointSet& points, const RegistrationConfig& config);

// Drops the rule about the probe's directions where there are none, or where nearly all of them point into the mesh at
// `guess`, which becomes a problem.
void check_facing(const RegistrationSurface& surface, const PointSet& points, const CentredPose& guess,
                  std::span<const std::uint32_t> chosen, MatchRules& rules, Problems& problems);

}  // namespace asperity::registration
