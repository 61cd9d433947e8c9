#include "match_rules.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "asperity/base/error.h"

namespace asperity::registration {

void check_surface(const RegistrationSurface& surface) {
  if (surface.mesh == nullptr || surface.bvh == nullptr || surface.facets.size() != surface.mesh->triangles.size()) {
    throw Error("registration: the surface was not prepared from its mesh");
  }
}

MatchRules match_rules(const RegistrationConfig& config) {
  MatchRules out;
  out.normals = config.normals;
  out.facing_cos = config.facing_deg < 180.0 ? std::cos(config.facing_deg * std::numbers::pi / 180.0) : -1.0;
  out.max_distance_m = config.max_distance_m;
  return out;
}

MatchRules weighing_rules(const PointSet& points, const RegistrationConfig& config) {
  MatchRules out = match_rules(config);
  if (std::any_of(points.outward.begin(), points.outward.end(), [](const auto& o) { return o.isZero(); })) {
    out.facing_cos = -1.0;
  }
  return out;
}

void check_facing(const RegistrationSurface& surface, const PointSet& points, const CentredPose& guess,
                  std::span<const std::uint32_t> chosen, MatchRules& rules, Problems& problems) {
  std::size_t given = 0;
  std::size_t against = 0;
  for (const std::uint32_t i : chosen) {
    if (points.outward[i].isZero()) continue;
    const ClosestPoint q = surface.bvh->closest_point(guess * points.x_m[i]);
    if (!q.found()) continue;
    ++given;
    const Eigen::Vector3d normal = surface.facets[q.triangle].normal.cast<double>();
    against += (guess.rotation * points.outward[i]).dot(normal) < rules.facing_cos ? 1 : 0;
  }
  if (given == 0) {
    rules.facing_cos = -1.0;
  } else if (10 * against > 9 * given) {
    rules.facing_cos = -1.0;
    problems.push_back({"outward_into_mesh",
                        "the probe's directions point into the mesh: its triangles may be inside out, or the guess is "
                        "wrong; the directions were not used",
                        against});
  }
}

}  // namespace asperity::registration
