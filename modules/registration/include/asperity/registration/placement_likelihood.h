#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "asperity/geometry/mesh_surface.h"
#include "asperity/registration/refine_registration.h"

namespace asperity {

// How well paths fit a mesh in one placement: −2 times the logarithm of the likelihood, up to a constant of the paths.
struct PlacementFit {
  Pose T_mesh_world;
  double cost = 0.0;
};

// Compares groupings of paths into placements (docs/registration.md, "Which scans share a placement"): costs with the
// same filter of each path, learnt where the path fits best alone, the pose of each placement free (without a guess's
// prior), slow errors, mean reliefs and the tip's position unknown as in refine_placements.h. The tip's position is
// fitted in each group apart, which favours more placements a little.
class PlacementLikelihood {
 public:
  PlacementLikelihood(std::span<const MeasuredPath> paths, const MeshSurface& surface, const RefineConfig& config);

  // The fit of path `path` alone that is the best of those from each start; its filter is learnt there.
  PlacementFit learn(std::size_t path, std::span<const Pose> starts);
  // The best fit of some paths together, from each start.
  PlacementFit fit(std::span<const std::size_t> paths, std::span<const Pose> starts) const;
  // Of a path's points.
  std::size_t points(std::size_t path) const { return paths_[path].p_world_m.size(); }

 private:
  struct Filters;
  std::span<const MeasuredPath> paths_;
  const MeshSurface& surface_;
  RefineConfig config_;
  std::shared_ptr<Filters> filters_;
};

// The excess of cost from which paths that are taken to share a placement do not: a placement has six numbers, and
// each pays the logarithm of the number of points (Schwarz 1978). Independent points are fewer than points: those that
// one correlation length holds count once.
double placement_threshold(double independent_points);

}  // namespace asperity
