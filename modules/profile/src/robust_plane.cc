#include "robust_plane.h"

#include <algorithm>
#include <cstddef>

#include "asperity/signal/statistics.h"

namespace asperity {

PlaneFit fit_robust_plane(const std::vector<Eigen::Vector3d>& points_m, double error_m, std::vector<double>& weights) {
  weights.assign(points_m.size(), 1.0);
  PlaneFit fit = fit_plane(points_m);
  std::vector<double> distance_m(points_m.size());
  for (int iteration = 0; iteration < 20; ++iteration) {
    for (std::size_t i = 0; i < points_m.size(); ++i)
      distance_m[i] = std::abs(fit.normal().dot(points_m[i] - fit.centroid_m));
    const double scale_m = 4.685 * std::max(error_m, kSigmaPerMad * median(distance_m));
    for (std::size_t i = 0; i < points_m.size(); ++i) {
      const double x = distance_m[i] / scale_m;
      const double tukey = x < 1.0 ? (1.0 - x * x) * (1.0 - x * x) : 0.0;
      weights[i] = iteration < 12 ? error_m / std::max(distance_m[i], error_m) : tukey;
    }
    fit = fit_plane(points_m, weights);
  }
  return fit;
}

}  // namespace asperity
