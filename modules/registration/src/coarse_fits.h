#pragma once

#include <cstdint>
#include <vector>

#include "fit_pose.h"

namespace asperity::registration {

// `count` poses about `guess`: turns within turn_deg and shifts within radius_m of it, evenly spread by a
// low-discrepancy sequence of six dimensions, the same at each call.
std::vector<CentredPose> sample_starts_around(const CentredPose& guess, int count, double radius_m, double turn_deg);

// The end of a coarse run, with the distances of its points (infinite without a pair).
struct CoarseRun {
  CentredPose pose;
  double scale_m = 0.0;
  double score_m2 = 0.0;  // mean robust cost at a width common to all runs
  std::vector<double> distances_m;
};

// Runs ICP from each start with few points and steps. The runs come back best first, those that ended at the same
// place as a better one left out.
std::vector<CoarseRun> run_coarse_fits(Matcher& matcher, const PointSet& points, const std::vector<CentredPose>& starts,
                                       const FitOptions& options, double least_width_m, std::size_t keep,
                                       IterationWatch& watch);

}  // namespace asperity::registration
