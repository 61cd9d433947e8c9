#include "fit_ellipsoid.h"

#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/SVD>

#include "asperity/algebra/solve.h"

namespace asperity {

namespace {

using Parameters = Eigen::Matrix<double, 9, 1>;

constexpr int kRow[6] = {0, 1, 1, 2, 2, 2};
constexpr int kColumn[6] = {0, 0, 1, 0, 1, 2};

Ellipsoid moved(const Ellipsoid& from, const Parameters& step, double g_mps2) {
  Ellipsoid out = from;
  for (int k = 0; k < 6; ++k) out.B(kRow[k], kColumn[k]) += step[k] / g_mps2;
  out.C += step.tail<3>();
  return out;
}

double cost(const EllipsoidFit& fit, const Eigen::VectorXd& weights) {
  if (weights.size() == 0) return fit.distance_counts.squaredNorm();
  return (weights.array() * fit.distance_counts.array().square()).sum();
}

bool usable(const Ellipsoid& ellipsoid) {
  return ellipsoid.B.allFinite() && ellipsoid.C.allFinite() && ellipsoid.B.diagonal().minCoeff() > 0.0;
}

// T lower triangular with M = TᵀT: Cholesky's factor of M with its axes in the reverse order.
Eigen::Matrix3d lower_root(const Eigen::Matrix3d& M) {
  const Eigen::Matrix3d reversed = M.reverse();
  const Eigen::Matrix3d L = Eigen::LLT<Eigen::Matrix3d>(reversed).matrixL();
  return Eigen::Matrix3d(L.transpose()).reverse();
}

}  // namespace

Ellipsoid start_ellipsoid(const std::vector<Eigen::Vector3d>& counts, double g_mps2) {
  const auto n = static_cast<Eigen::Index>(counts.size());
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& c : counts) mean += c / static_cast<double>(n);
  double size = 0.0;
  for (const Eigen::Vector3d& c : counts) size += (c - mean).squaredNorm() / static_cast<double>(n);
  size = std::sqrt(size);

  Eigen::MatrixXd sphere(n, 4);
  Eigen::MatrixXd quadric(n, 9);
  Eigen::VectorXd square(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Vector3d x = (counts[static_cast<std::size_t>(i)] - mean) / size;
    sphere.row(i) << 2.0 * x.transpose(), 1.0;
    quadric.row(i) << x.cwiseAbs2().transpose(), 2.0 * x.x() * x.y(), 2.0 * x.x() * x.z(), 2.0 * x.y() * x.z(),
        2.0 * x.transpose();
    square[i] = x.squaredNorm();
  }
  const Eigen::Vector4d s = least_squares(sphere, square).x;
  Ellipsoid out;
  out.C = mean + size * s.head<3>();
  out.B *= size * std::sqrt(std::max(s[3] + s.head<3>().squaredNorm(), 0.01)) / g_mps2;

  const Parameters q = least_squares(quadric, Eigen::VectorXd::Ones(n)).x;
  Eigen::Matrix3d A;
  A << q[0], q[3], q[4], q[3], q[1], q[5], q[4], q[5], q[2];
  if (Eigen::LLT<Eigen::Matrix3d>(A).info() != Eigen::Success) return out;
  const Eigen::Vector3d centre = -A.inverse() * q.tail<3>();
  const Eigen::Matrix3d M = A / (1.0 + centre.dot(A * centre));
  const Ellipsoid found{lower_root(M).inverse() * (size / g_mps2), mean + size * centre};
  return usable(found) ? found : out;
}

EllipsoidFit measure_ellipsoid(const std::vector<Eigen::Vector3d>& counts, const Ellipsoid& ellipsoid, double g_mps2) {
  EllipsoidFit out;
  out.ellipsoid = ellipsoid;
  const auto n = static_cast<Eigen::Index>(counts.size());
  out.distance_counts.resize(n);
  out.slope.resize(n, 9);
  const Eigen::Matrix3d inverse = ellipsoid.B.inverse();
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Vector3d f = inverse * (counts[static_cast<std::size_t>(i)] - ellipsoid.C);
    const Eigen::Vector3d gradient = inverse.transpose() * f.normalized();
    const double steep = gradient.norm();
    out.distance_counts[i] = (f.norm() - g_mps2) / steep;
    for (int k = 0; k < 6; ++k) out.slope(i, k) = -gradient[kRow[k]] / steep * f[kColumn[k]] / g_mps2;
    out.slope.row(i).tail<3>() = -gradient.transpose() / steep;
  }
  return out;
}

EllipsoidFit fit_ellipsoid(const std::vector<Eigen::Vector3d>& counts, const Eigen::VectorXd& weights,
                           const Ellipsoid& start, double g_mps2) {
  EllipsoidFit at = measure_ellipsoid(counts, start, g_mps2);
  double now = cost(at, weights);
  constexpr int kMostSteps = 100;
  double damping = 1e-6;
  for (int step = 0; step < kMostSteps; ++step) {
    Eigen::MatrixXd J = at.slope;
    Eigen::VectorXd r = at.distance_counts;
    if (weights.size() > 0) {
      const Eigen::VectorXd root = weights.cwiseSqrt();
      J = root.asDiagonal() * J;
      r = root.cwiseProduct(r);
    }
    Eigen::Matrix<double, 9, 9> H = J.transpose() * J;
    const Parameters down = -J.transpose() * r;
    H.diagonal() += damping * Parameters::Constant(H.diagonal().maxCoeff());
    const Parameters change = solve_symmetric(H, down);
    const Ellipsoid next = moved(at.ellipsoid, change, g_mps2);
    if (change.allFinite() && usable(next)) {
      EllipsoidFit there = measure_ellipsoid(counts, next, g_mps2);
      const double then = cost(there, weights);
      if (then <= now) {
        const bool small = change.norm() <= 1e-10 * (g_mps2 * next.B.norm());
        at = std::move(there);
        now = then;
        damping = std::max(0.1 * damping, 1e-14);
        if (small) {
          at.converged = true;
          break;
        }
        continue;
      }
      if (change.norm() <= 1e-9 * (g_mps2 * next.B.norm())) {
        at.converged = true;
        break;
      }
    }
    damping *= 10.0;
    if (damping > 1e6) break;
  }
  return at;
}

}  // namespace asperity
