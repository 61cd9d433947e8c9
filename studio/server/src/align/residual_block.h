#pragma once

#include <vector>

#include "align/align_scene.h"
#include "asperity/geometry/mesh_bvh.h"
#include "asperity/geometry/pose.h"
#include "asperity/studio/block.h"

namespace asperity::studio {

// How far the points of a scene are from its mesh, as a block of kind "align.residuals". Head: mean_m, rms_m, most_m of
// the distances; rms_sigma, of them over their σ, and median_sigma_m, null where no σ is stated; overlap_m
// (scan_overlaps.h). Arrays, one a point: distance_m f32, sigma_m f32 (residual_sigma.h), overlap u8: kNearScan and
// kOnTexture.
// `poses` is empty, or one a path: then `pose` is only where the closest points are looked for from one call to the
// next. `closest` is what the last call for this scene has left there, or empty.
BlockWriter residual_block(const AlignScene& scene, const Pose& pose, const std::vector<Pose>& poses,
                           std::vector<ClosestPoint>& closest);

}  // namespace asperity::studio
