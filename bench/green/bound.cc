#include "bound.h"

#include <cmath>
#include <limits>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

namespace bench {

PoseDifference pose_bound(const std::vector<LineOnMesh>& lines, const PathErrors& errors, const Symmetry& symmetry) {
  using Eigen::Vector3d;
  constexpr double kStep_m = 1e-3;
  constexpr auto kEvery = static_cast<std::size_t>(kStep_m / kPathSpacing_m);
  struct Point {
    std::size_t line;
    double s_m;
    Vector3d p_m, n;
  };
  std::vector<Point> points;
  Vector3d centre_m = Vector3d::Zero();
  for (std::size_t l = 0; l < lines.size(); ++l) {
    for (std::size_t i = 0; i < lines[l].p_m.size(); i += kEvery) {
      points.push_back({l, static_cast<double>(i) * kPathSpacing_m, lines[l].p_m[i], lines[l].normal[i]});
      centre_m += lines[l].p_m[i];
    }
  }
  const auto count = static_cast<Eigen::Index>(points.size());
  centre_m /= static_cast<double>(points.size());
  Eigen::MatrixXd covariance_m2(count, count), rows(count, 6);
  Eigen::Matrix<double, 6, 6> metric = Eigen::Matrix<double, 6, 6>::Zero();
  const double averaged_m2 = errors.white_m * errors.white_m * kPathSpacing_m / kStep_m +
                             errors.relief_m * errors.relief_m * std::min(1.0, 2.0 * errors.relief_length_m / kStep_m);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Point& a = points[static_cast<std::size_t>(i)];
    rows.row(i) << (a.p_m - centre_m).cross(a.n).transpose(), a.n.transpose();
    Eigen::Matrix<double, 3, 6> motion;
    motion << -asperity::skew(a.p_m - centre_m), Eigen::Matrix3d::Identity();
    metric += motion.transpose() * motion / static_cast<double>(count);
    for (Eigen::Index k = 0; k < count; ++k) {
      const Point& b = points[static_cast<std::size_t>(k)];
      const double same = a.line == b.line ? 1.0 : 0.0;
      // The probe leans as the normals do: the tip's place turns with them.
      covariance_m2(i, k) = same * a.n.dot(b.n) * errors.slow_m * errors.slow_m *
                                std::exp(-std::abs(a.s_m - b.s_m) / errors.slow_length_m) +
                            errors.tip_sigma_m * errors.tip_sigma_m + same * errors.relief_m * errors.relief_m / 3.0 +
                            (i == k ? averaged_m2 : 0.0);
    }
  }
  Eigen::Matrix<double, 6, 6> information = rows.transpose() * covariance_m2.llt().solve(rows);
  const double along_axes = information.bottomRightCorner<3, 3>().trace();
  const double stiff = 1e9 * information.trace();
  const auto known = [&](const Vector3d& axis) {
    Eigen::Matrix<double, 6, 1> v;
    v << axis, axis.cross(centre_m);
    v.normalize();
    information += stiff * v * v.transpose();
  };
  if (!symmetry.axis.isZero()) known(symmetry.axis);
  if (symmetry.sphere) {
    for (int k = 0; k < 3; ++k) known(Vector3d::Unit(k));
  }
  // What is known a thousand times less well than the rest is not bounded: rounding alone may be what is left of it.
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> modes(
      information, metric, Eigen::EigenvaluesOnly | Eigen::Ax_lBx);
  if (!(modes.eigenvalues()[0] > 1e-6 * along_axes)) {
    return {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  }
  const Eigen::Matrix<double, 6, 6> inverse = information.inverse();
  return {std::sqrt(std::max(0.0, (metric * inverse).trace())),
          std::sqrt(std::max(0.0, inverse.topLeftCorner<3, 3>().trace()))};
}

}  // namespace bench
