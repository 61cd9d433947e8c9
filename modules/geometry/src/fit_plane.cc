#include "asperity/geometry/fit_plane.h"

#include <cmath>
#include <limits>
#include <string>

#include <Eigen/Geometry>

#include "asperity/algebra/solve.h"
#include "asperity/base/error.h"

namespace asperity {

PlaneFit fit_plane(std::span<const Eigen::Vector3d> points_m, std::span<const double> weights) {
  const std::size_t n = points_m.size();
  if (n < 3) throw Error("fit_plane: " + std::to_string(n) + " points, at least 3 are needed");
  if (!weights.empty() && weights.size() != n) {
    throw Error("fit_plane: " + std::to_string(weights.size()) + " weights for " + std::to_string(n) + " points");
  }
  double sum = 0.0;
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < n; ++i) {
    const double w = weights.empty() ? 1.0 : weights[i];
    if (!points_m[i].allFinite() || !(w >= 0.0) || !std::isfinite(w)) {
      throw Error("fit_plane: point " + std::to_string(i) + " or its weight is not a finite number");
    }
    sum += w;
    centroid += w * points_m[i];
  }
  if (!(sum > 0.0)) throw Error("fit_plane: all weights are zero");
  centroid /= sum;

  Eigen::MatrixX3d rows(static_cast<Eigen::Index>(n), 3);
  for (std::size_t i = 0; i < n; ++i) {
    const double w = weights.empty() ? 1.0 : weights[i];
    rows.row(static_cast<Eigen::Index>(i)) = std::sqrt(w / sum) * (points_m[i] - centroid).transpose();
  }
  const SingularValues svd = singular_values(rows, SingularVectors::kFullV);

  PlaneFit fit;
  fit.centroid_m = centroid;
  fit.axes = svd.V;
  if (fit.axes.determinant() < 0.0) fit.axes.col(2) *= -1.0;
  fit.scatter_m2 = svd.values.cwiseAbs2();
  fit.rms_m = std::sqrt(fit.scatter_m2.z());
  const double freedom = static_cast<double>(n) - 3.0;
  for (int k = 0; k < 2; ++k) {
    const bool determined = freedom > 0.0 && fit.scatter_m2[k] > 0.0;
    fit.tilt_stderr_rad[k] = determined ? std::sqrt(fit.scatter_m2.z() / (freedom * fit.scatter_m2[k]))
                                        : std::numeric_limits<double>::infinity();
  }
  return fit;
}

}  // namespace asperity
