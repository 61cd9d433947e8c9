#include "asperity/geometry/fit_circle.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "asperity/algebra/solve.h"
#include "asperity/base/error.h"

namespace asperity {

namespace {

constexpr int kMaxIterations = 100;

struct Circle {
  Eigen::Vector2d centre;
  double radius;
};

// Pratt's fit by the singular value decomposition, of points that are centred and scaled to unit size.
Circle fit_algebraic(const std::vector<Eigen::Vector2d>& p, const std::vector<double>& w) {
  const auto n = static_cast<Eigen::Index>(p.size());
  Eigen::MatrixX4d rows(n, 4);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Vector2d& q = p[static_cast<std::size_t>(i)];
    rows.row(i) = std::sqrt(w[static_cast<std::size_t>(i)]) * Eigen::RowVector4d(q.squaredNorm(), q.x(), q.y(), 1.0);
  }
  const SingularValues svd = singular_values(rows, SingularVectors::kFullV);
  Eigen::Vector4d a;
  if (svd.values(3) < 1e-12 * svd.values(0)) {
    a = svd.V.col(3);
  } else {
    const Eigen::Matrix4d y = svd.V * svd.values.asDiagonal() * svd.V.transpose();
    Eigen::Matrix4d constraint_inverse = Eigen::Matrix4d::Zero();
    constraint_inverse(0, 3) = constraint_inverse(3, 0) = -0.5;
    constraint_inverse(1, 1) = constraint_inverse(2, 2) = 1.0;
    const SymmetricEigen eigen = symmetric_eigen(y * constraint_inverse * y);
    // The eigenvalues rise and exactly one is negative: the fit belongs to the least positive one.
    a = solve_symmetric(y, eigen.vectors.col(1));
  }
  // A vanishing quadratic term is a straight line: a very large circle stands for it.
  const double side = a(0) < 0.0 ? -1.0 : 1.0;
  const double quadratic = side * std::max(std::abs(a(0)), 1e-9 * a.norm());
  const Eigen::Vector2d centre = -0.5 * a.segment<2>(1) / quadratic;
  const double square = centre.squaredNorm() - a(3) / quadratic;
  return {centre, std::sqrt(std::max(square, 0.0))};
}

}  // namespace

double CircleFit::radius_stderr_m() const { return std::sqrt(covariance_m2(2, 2)); }

double CircleFit::curvature_stderr_per_m() const { return radius_stderr_m() / (radius_m * radius_m); }

CircleFit fit_circle(std::span<const Eigen::Vector2d> points_m, std::span<const double> weights) {
  const std::size_t n = points_m.size();
  if (n < 3) throw Error("fit_circle: " + std::to_string(n) + " points, at least 3 are needed");
  if (!weights.empty() && weights.size() != n) {
    throw Error("fit_circle: " + std::to_string(weights.size()) + " weights for " + std::to_string(n) + " points");
  }
  double sum = 0.0;
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  std::vector<double> w(n);
  for (std::size_t i = 0; i < n; ++i) {
    w[i] = weights.empty() ? 1.0 : weights[i];
    if (!points_m[i].allFinite() || !(w[i] >= 0.0) || !std::isfinite(w[i])) {
      throw Error("fit_circle: point " + std::to_string(i) + " or its weight is not a finite number");
    }
    sum += w[i];
    mean += w[i] * points_m[i];
  }
  if (!(sum > 0.0)) throw Error("fit_circle: all weights are zero");
  mean /= sum;
  double square = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    w[i] /= sum;
    square += w[i] * (points_m[i] - mean).squaredNorm();
  }
  const double scale = std::sqrt(square);
  CircleFit fit;
  fit.centre_m = mean;
  if (!(scale > 0.0)) return fit;

  std::vector<Eigen::Vector2d> p(n);
  for (std::size_t i = 0; i < n; ++i) p[i] = (points_m[i] - mean) / scale;
  Circle circle = fit_algebraic(p, w);

  const auto cost_of = [&](const Circle& c) {
    double cost = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      const double r = (p[i] - c.centre).norm() - c.radius;
      cost += w[i] * r * r;
    }
    return cost;
  };
  double cost = cost_of(circle);
  double damping = 0.0;
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  for (fit.iterations = 0; fit.iterations < kMaxIterations && !fit.converged; ++fit.iterations) {
    information.setZero();
    Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < n; ++i) {
      const Eigen::Vector2d d = circle.centre - p[i];
      const double distance = d.norm();
      if (!(distance > 0.0)) continue;
      const Eigen::Vector3d j(d.x() / distance, d.y() / distance, -1.0);
      information += w[i] * j * j.transpose();
      gradient += w[i] * (distance - circle.radius) * j;
    }
    bool improved = false;
    for (int attempt = 0; attempt < 12 && !improved; ++attempt) {
      Eigen::Matrix3d damped = information;
      damped.diagonal() *= 1.0 + damping;
      const Eigen::Vector3d step = -solve_symmetric(damped, gradient);
      const Circle next{circle.centre + step.head<2>(), circle.radius + step.z()};
      const double next_cost = step.allFinite() ? cost_of(next) : std::numeric_limits<double>::infinity();
      if (next_cost <= cost) {
        // Relative to the radius: a short arc moves centre and radius together along a flat valley.
        fit.converged = step.norm() <= 1e-10 * (1.0 + circle.radius) || cost - next_cost <= 1e-14 * cost;
        circle = next;
        cost = next_cost;
        damping *= 0.1;
        improved = true;
      } else {
        damping = std::max(1e-6, 10.0 * damping);
      }
    }
    if (!improved) fit.converged = true;
  }
  // Beyond this the arc's bow is below a double's resolution of the points.
  fit.converged = fit.converged && std::isfinite(circle.radius) && circle.radius < 1e6;
  fit.centre_m = mean + scale * circle.centre;
  fit.radius_m = scale * std::abs(circle.radius);
  fit.rms_m = scale * std::sqrt(cost);
  const double freedom = static_cast<double>(n) - 3.0;
  fit.covariance_m2 =
      freedom > 0.0
          ? Eigen::Matrix3d(scale * scale * cost / freedom * solve_symmetric(information, Eigen::Matrix3d::Identity()))
          : Eigen::Matrix3d::Constant(std::numeric_limits<double>::infinity());
  return fit;
}

}  // namespace asperity
