#pragma once

#include <vector>

#include <Eigen/Core>

namespace asperity {

// counts = B f + C with |f| = g, B lower triangular.
struct Ellipsoid {
  Eigen::Matrix3d B = Eigen::Matrix3d::Identity();
  Eigen::Vector3d C = Eigen::Vector3d::Zero();
};

struct EllipsoidFit {
  Ellipsoid ellipsoid;
  Eigen::VectorXd distance_counts;                 // from the ellipsoid along its gradient, positive outside
  Eigen::Matrix<double, Eigen::Dynamic, 9> slope;  // of the distances over g·(B11, B21, B22, B31, B32, B33) and C
  bool converged = false;
};

// The sphere, then the ellipsoid, that solve their equations best in the algebraic sense, to start from. The sphere
// is kept where the points give no ellipsoid.
Ellipsoid start_ellipsoid(const std::vector<Eigen::Vector3d>& counts, double g_mps2);

// Weighted least squares of the distances; `weights` is empty or has one entry a point.
EllipsoidFit fit_ellipsoid(const std::vector<Eigen::Vector3d>& counts, const Eigen::VectorXd& weights,
                           const Ellipsoid& start, double g_mps2);

// Distances and slopes of given points at a given ellipsoid.
EllipsoidFit measure_ellipsoid(const std::vector<Eigen::Vector3d>& counts, const Ellipsoid& ellipsoid, double g_mps2);

}  // namespace asperity
