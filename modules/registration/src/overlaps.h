#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "path_chain.h"

namespace asperity::registration {

// Two points of paths, a and a point between b and b + 1, that are the same point of the object: in height (where
// strokes cross or run beside each other: whatever the mesh is wrong by, both have it), or along b's path (where their
// textures match).
struct OverlapLink {
  std::size_t a = 0, b = 0;
  double share = 0.0;  // of b + 1
  bool along = false;  // along the path; else along the normal
  double sigma_m = 0.0;
  std::size_t from = 0, to = 0;  // points of b's path about it that give its direction
};

// How far the two are apart: the unit direction in the mesh frame, and the distance along it.
struct LinkResidual {
  bool known = false;
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  double value_m = 0.0;
};
LinkResidual link_residual(const OverlapLink& link, const FacetHeights& heights);

// The links between all paths, and within paths that double back, as they are at `heights`
// (docs/registration-placements.md, "Overlapping scans"). `reach_m`: strokes farther apart, across, do not meet the
// same texture.
std::vector<OverlapLink> find_overlaps(const PathChain& chain, const FacetHeights& heights, double reach_m);

}  // namespace asperity::registration
