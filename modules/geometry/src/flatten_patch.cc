#include "asperity/geometry/flatten_patch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include <Eigen/Dense>
#include <Eigen/SparseCore>

#include "asperity/algebra/sparse_cholesky.h"
#include "asperity/base/error.h"
#include "asperity/geometry/flat_triangle.h"
#include "singular_values_2d.h"

namespace asperity {
namespace {

using Triplet = Eigen::Triplet<double>;
using Row4 = Eigen::Matrix<double, 4, 6>;

// A triangle at rest: the map F = [q1 − q0, q2 − q0] rest⁻¹ of its corners q, written as vec(F) = G (q0, q1, q2) with
// vec(F) = (F00, F10, F01, F11).
struct RestTriangle {
  std::array<std::uint32_t, 3> corner{};
  double area = 0.0;  // as a part of the patch's
  Row4 G = Row4::Zero();
};

std::vector<RestTriangle> rest_triangles(const TriangleMesh& mesh, FlatPatch& out, double& area_m2) {
  std::vector<RestTriangle> rest;
  area_m2 = 0.0;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const FlatTriangle flat = flatten_triangle(mesh, t);
    Eigen::Matrix2d edges;
    edges << flat.corner[1] - flat.corner[0], flat.corner[2] - flat.corner[0];
    const double twice_area = edges.determinant();
    // Below this an inverse has no digits.
    if (!(twice_area > 1e-12 * edges.squaredNorm())) {
      ++out.without_area;
      continue;
    }
    RestTriangle one;
    one.corner = mesh.triangles[t];
    one.area = 0.5 * twice_area;
    const Eigen::Matrix2d inverse = edges.inverse();
    Eigen::Matrix<double, 2, 3> weight;  // of q0, q1, q2 on F's columns
    weight << -inverse(0, 0) - inverse(1, 0), inverse(0, 0), inverse(1, 0), -inverse(0, 1) - inverse(1, 1),
        inverse(0, 1), inverse(1, 1);
    for (int column = 0; column < 2; ++column)
      for (int corner = 0; corner < 3; ++corner)
        for (int axis = 0; axis < 2; ++axis) one.G(2 * column + axis, 2 * corner + axis) = weight(column, corner);
    rest.push_back(one);
    area_m2 += one.area;
  }
  for (RestTriangle& one : rest) one.area /= area_m2;
  return rest;
}

// Tutte's embedding: the border on a circle of the patch's area, each other vertex the mean of its neighbours.
Eigen::VectorXd embed_on_circle(const SurfacePatch& patch, double area_m2) {
  const auto n = static_cast<Eigen::Index>(patch.mesh.vertices_m.size());
  std::vector<char> fixed(patch.mesh.vertices_m.size(), 0);
  Eigen::VectorXd out = Eigen::VectorXd::Zero(2 * n);
  std::vector<double> along{0.0};
  for (std::size_t i = 0; i < patch.border.size(); ++i) {
    const auto& a = patch.mesh.vertices_m[patch.border[i]];
    const auto& b = patch.mesh.vertices_m[patch.border[(i + 1) % patch.border.size()]];
    along.push_back(along.back() + std::max((b - a).norm(), 1e-9 * std::sqrt(area_m2)));
  }
  const double radius_m = std::sqrt(area_m2 / std::numbers::pi);
  for (std::size_t i = 0; i < patch.border.size(); ++i) {
    const double angle = 2.0 * std::numbers::pi * along[i] / along.back();
    out.segment<2>(2 * static_cast<Eigen::Index>(patch.border[i])) =
        radius_m * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    fixed[patch.border[i]] = 1;
  }
  std::vector<Triplet> entries;
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(n, 2);
  const auto couple = [&](std::uint32_t a, std::uint32_t b) {
    if (fixed[a] != 0) return;
    entries.emplace_back(a, a, 1.0);
    if (fixed[b] != 0) {
      right.row(a) += out.segment<2>(2 * static_cast<Eigen::Index>(b)).transpose();
    } else {
      entries.emplace_back(a, b, -1.0);
    }
  };
  // Each inner edge is met from both of its triangles, each border edge ends at fixed vertices: weights are alike.
  for (const Triangle& t : patch.mesh.triangles) {
    for (std::size_t e = 0; e < 3; ++e) {
      couple(t[e], t[(e + 1) % 3]);
      couple(t[(e + 1) % 3], t[e]);
    }
  }
  for (Eigen::Index v = 0; v < n; ++v) {
    if (fixed[static_cast<std::size_t>(v)] == 0) continue;
    entries.emplace_back(v, v, 1.0);
    right.row(v) = out.segment<2>(2 * v).transpose();
  }
  Eigen::SparseMatrix<double> laplacian(n, n);
  laplacian.setFromTriplets(entries.begin(), entries.end());
  const SparseCholesky cholesky(laplacian);
  if (!cholesky.positive_definite()) throw Error("area: the strokes' patch has vertices that nothing joins");
  const Eigen::MatrixXd place = cholesky.solve(right);
  for (Eigen::Index v = 0; v < n; ++v) out.segment<2>(2 * v) = place.row(v).transpose();
  return out;
}

Eigen::Matrix<double, 6, 1> corners_of(const RestTriangle& one, const Eigen::VectorXd& q) {
  Eigen::Matrix<double, 6, 1> out;
  for (int c = 0; c < 3; ++c)
    out.segment<2>(2 * c) = q.segment<2>(2 * static_cast<Eigen::Index>(one.corner[static_cast<std::size_t>(c)]));
  return out;
}

Eigen::Matrix2d map_of(const RestTriangle& one, const Eigen::VectorXd& q) {
  const Eigen::Vector4d f = one.G * corners_of(one, q);
  Eigen::Matrix2d F;
  F << f[0], f[2], f[1], f[3];
  return F;
}

// ½ (|F|² + |F⁻¹|²); infinite where F turns over.
double density(const Eigen::Matrix2d& F) {
  const double det = F.determinant();
  if (!(det > 0.0)) return std::numeric_limits<double>::infinity();
  const double square = F.squaredNorm();
  return 0.5 * square * (1.0 + 1.0 / (det * det));
}

double energy_of(const std::vector<RestTriangle>& rest, const Eigen::VectorXd& q) {
  double out = 0.0;
  for (const RestTriangle& one : rest) out += one.area * density(map_of(one, q));
  return out;
}

// Gradient by vec(F), and the Hessian without its negative part, by the eigensystem in closed form: the two scalings,
// the twist and the flip of F = U diag(σ₁, σ₂) Vᵀ.
void differentiate(const Eigen::Matrix2d& F, Eigen::Vector4d& gradient, Eigen::Matrix4d& hessian) {
  const SingularValues2d s = singular_values_2d(F);
  const double a = s.high, b = s.low;
  const auto vec = [](const Eigen::Matrix2d& m) { return Eigen::Vector4d(m(0, 0), m(1, 0), m(0, 1), m(1, 1)); };
  const auto outer = [&](double p, double r, double t, double u) {
    Eigen::Matrix2d middle;
    middle << p, r, t, u;
    return vec(s.U * middle * s.V.transpose());
  };
  const double a3 = 1.0 / (a * a * a), b3 = 1.0 / (b * b * b);
  const Eigen::Vector4d first = outer(1, 0, 0, 0), second = outer(0, 0, 0, 1);
  const Eigen::Vector4d twist = std::numbers::sqrt2 / 2.0 * outer(0, -1, 1, 0);
  const Eigen::Vector4d flip = std::numbers::sqrt2 / 2.0 * outer(0, 1, 1, 0);
  const double product3 = a3 * b3;  // (σ₁ σ₂)⁻³
  gradient = (a - a3) * first + (b - b3) * second;
  const double of_twist = std::max(0.0, 1.0 - (a * a - a * b + b * b) * product3);
  const double of_flip = 1.0 + (a * a + a * b + b * b) * product3;
  hessian = (1.0 + 3.0 * a3 / a) * first * first.transpose() + (1.0 + 3.0 * b3 / b) * second * second.transpose() +
            of_twist * twist * twist.transpose() + of_flip * flip * flip.transpose();
}

struct NewtonSystem {
  Eigen::VectorXd gradient;
  Eigen::SparseMatrix<double> hessian;
};

NewtonSystem assemble(const std::vector<RestTriangle>& rest, const Eigen::VectorXd& q) {
  NewtonSystem out;
  out.gradient = Eigen::VectorXd::Zero(q.size());
  std::vector<Triplet> entries;
  entries.reserve(36 * rest.size() + static_cast<std::size_t>(q.size()));
  double trace = 0.0;
  for (const RestTriangle& one : rest) {
    Eigen::Vector4d gradient;
    Eigen::Matrix4d hessian;
    differentiate(map_of(one, q), gradient, hessian);
    const Eigen::Matrix<double, 6, 1> g = one.area * (one.G.transpose() * gradient);
    const Eigen::Matrix<double, 6, 6> h = one.area * (one.G.transpose() * hessian * one.G);
    trace += h.trace();
    for (int i = 0; i < 6; ++i) {
      const auto row = static_cast<int>(2 * one.corner[static_cast<std::size_t>(i / 2)]) + i % 2;
      out.gradient[row] += g[i];
      for (int j = 0; j < 6; ++j) {
        const auto column = static_cast<int>(2 * one.corner[static_cast<std::size_t>(j / 2)]) + j % 2;
        if (column <= row) entries.emplace_back(row, column, h(i, j));
      }
    }
  }
  // Shifts and rotations of all cost nothing; a trace of stiffness makes the equations regular.
  const double shift = 1e-10 * trace / static_cast<double>(q.size());
  for (Eigen::Index i = 0; i < q.size(); ++i) entries.emplace_back(static_cast<int>(i), static_cast<int>(i), shift);
  out.hessian.resize(q.size(), q.size());
  out.hessian.setFromTriplets(entries.begin(), entries.end());
  return out;
}

// The largest step along d before a triangle loses its area: the least positive root of det(F + t D).
double largest_step(const std::vector<RestTriangle>& rest, const Eigen::VectorXd& q, const Eigen::VectorXd& d) {
  double out = std::numeric_limits<double>::infinity();
  for (const RestTriangle& one : rest) {
    const Eigen::Matrix2d F = map_of(one, q), D = map_of(one, d);
    const double c = F.determinant(), a = D.determinant();
    const double b = F(0, 0) * D(1, 1) + D(0, 0) * F(1, 1) - F(0, 1) * D(1, 0) - D(0, 1) * F(1, 0);
    const double inside = b * b - 4.0 * a * c;
    if (inside < 0.0) continue;
    // c > 0: with the larger of the two sums both roots keep their digits.
    const double w = -0.5 * (b + std::copysign(std::sqrt(inside), b));
    for (const double root : {a != 0.0 ? w / a : -1.0, w != 0.0 ? c / w : -1.0})
      if (root > 0.0) out = std::min(out, root);
  }
  return out;
}

void measure(const std::vector<RestTriangle>& rest, const Eigen::VectorXd& q, FlatPatch& out) {
  double square = 0.0;
  out.stretch_min = std::numeric_limits<double>::infinity();
  out.stretch_max = 0.0;
  for (const RestTriangle& one : rest) {
    const Eigen::Matrix2d F = map_of(one, q);
    const SingularValues2d s = singular_values_2d(F);
    out.stretch_min = std::min(out.stretch_min, s.low);
    out.stretch_max = std::max(out.stretch_max, s.high);
    square += 0.5 * one.area * (std::pow(s.low - 1.0, 2) + std::pow(s.high - 1.0, 2));
    if (!(F.determinant() > 0.0)) ++out.flipped;
  }
  out.stretch_rms = std::sqrt(square);
}

}  // namespace

FlatPatch flatten_patch(const SurfacePatch& patch, const FlattenConfig& config) {
  FlatPatch out;
  double area_m2 = 0.0;
  const std::vector<RestTriangle> rest = rest_triangles(patch.mesh, out, area_m2);
  if (rest.empty()) throw Error("area: the strokes' patch has no area");
  Eigen::VectorXd q = embed_on_circle(patch, area_m2);
  double energy = energy_of(rest, q);
  std::unique_ptr<SparseCholesky> cholesky;
  while (out.iterations < config.iterations && std::isfinite(energy)) {
    ++out.iterations;
    const NewtonSystem system = assemble(rest, q);
    if (cholesky) {
      cholesky->factorize(system.hessian);
    } else {
      cholesky = std::make_unique<SparseCholesky>(system.hessian);
    }
    if (!cholesky->positive_definite())
      throw Error("area: the parametrisation's equations cannot be solved: the patch has triangles of hardly any area");
    const Eigen::VectorXd d = cholesky->solve(-system.gradient);
    const double slope = system.gradient.dot(d);
    double step = std::min(1.0, 0.9 * largest_step(rest, q, d));
    double next = energy_of(rest, q + step * d);
    constexpr double kSufficient = 1e-4;  // of the slope (Armijo 1966)
    constexpr double kSmallestStep = 1e-12;
    while (!(next <= energy + kSufficient * step * slope) && step > kSmallestStep) {
      step *= 0.5;
      next = energy_of(rest, q + step * d);
    }
    // What the whole step promises (half of Newton's decrement), and not what was gained: a step that a triangle's edge
    // cuts short gains little far from the least energy.
    const double promised = -0.5 * slope;
    if (!(next < energy)) {
      constexpr double kRounding = 1e-10;
      out.converged = promised <= std::max(config.tolerance, kRounding) * energy;
      break;
    }
    q += step * d;
    energy = next;
    if (promised <= config.tolerance * energy) {
      out.converged = true;
      break;
    }
  }
  if (!std::isfinite(energy))
    throw Error("area: the patch cannot be flattened to a circle without flipping a triangle");
  out.energy = energy;
  measure(rest, q, out);
  for (Eigen::Index v = 0; 2 * v < q.size(); ++v) out.uv_m.emplace_back(q[2 * v], q[2 * v + 1]);
  return out;
}

}  // namespace asperity
