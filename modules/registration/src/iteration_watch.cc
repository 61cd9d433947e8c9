#include "iteration_watch.h"

#include <algorithm>
#include <cmath>

namespace asperity::registration {

void IterationWatch::report(const Matcher& matcher, const PointSet& points, const CentredPose& pose,
                            double width_m) const {
  if (!wants_iterations()) return;
  double square_m2 = 0.0;
  std::size_t inliers = 0;
  for (const Match& match : matcher.matches()) {
    if (!match.usable || !(std::abs(match.distance_m) <= width_m)) continue;
    square_m2 += match.distance_m * match.distance_m;
    ++inliers;
  }
  const double rms_m = inliers == 0 ? 0.0 : std::sqrt(square_m2 / static_cast<double>(inliers));
  report(uncentred(pose, points), rms_m, matcher.size(), inliers);
}

void IterationWatch::report(const Pose& T_mesh_world, double rms_m, std::size_t points, std::size_t inliers) const {
  if (!wants_iterations()) return;
  observer_.iterated({phase_, std::max(start_, 0), T_mesh_world, rms_m, points, inliers});
}

}  // namespace asperity::registration
