#pragma once

#include <cstdint>
#include <vector>

#include "asperity/geometry/pose.h"

namespace asperity::studio {

struct AlignScene;

// Why a point is marked as one of an overlap.
inline constexpr std::uint8_t kNearScan = 1;   // another scan passes there
inline constexpr std::uint8_t kOnTexture = 2;  // a triangle that has the texture of a scan in the scene

// How near two scans are where they overlap: the distance at which registration links them and one spacing of their
// points (docs/registration-placements.md, "Overlapping scans").
double overlap_reach_m(const AlignScene& scene);

// Of each point that is drawn: kNearScan if a point of another scan, thinned or not, is within that distance; 0
// otherwise. `T_mesh_world` has a pose for each scan, or is empty: all have one pose.
std::vector<std::uint8_t> scan_overlaps(const AlignScene& scene, const std::vector<Pose>& T_mesh_world);

}  // namespace asperity::studio
