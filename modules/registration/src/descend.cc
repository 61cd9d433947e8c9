#include "descend.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/SparseCholesky>

namespace asperity::registration {

namespace {

constexpr double kSmallStep = 1e-3;  // squared, in standard deviations

// L D Lᵀ of the lower triangle in an order of least fill (approximate minimum degree): the pattern alone decides it.
using Factor = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower>;

}  // namespace

bool has_variance(std::span<const Whitening> whitening) {
  return std::any_of(whitening.begin(), whitening.end(),
                     [](const Whitening& filter) { return filter.variance_m2 > 0.0; });
}

Refined descend_to_minimum(const Refinement& problem, const State& start, std::span<const Whitening> whitening,
                           int max_iterations, IterationWatch& watch, FacetKinks kinks) {
  watch.next_start();
  Refined out;
  out.state = start;
  out.state.bulge_m.clear();
  out.heights = problem.heights(out.state);
  if (kinks == FacetKinks::kIgnored) {
    out.state.bulge_m = out.heights.here_m;
    out.heights = problem.heights(out.state);
  }
  Factor factor;
  for (int k = 0; k < max_iterations; ++k) {
    ++out.iterations;
    watch.check();
    watch.report(out.state.T_mesh_world.front(), out.heights.rms_m, out.heights.d_m.size(), out.heights.count);
    Equations equations = problem.equations(out.state, out.heights, whitening);
    out.cost = equations.cost;
    if (equations.rows < kLeastPoints) return out;
    out.information = std::move(equations.information);
    factor.compute(out.information);
    if (factor.info() != Eigen::Success) return out;
    const Eigen::VectorXd step = factor.solve(equations.right);
    if (!step.allFinite()) return out;
    double share = 1.0;
    bool fell = false;
    for (int halving = 0; halving < 5 && !fell; ++halving, share *= 0.5) {
      const State next = problem.moved(out.state, share * step);
      FacetHeights there = problem.heights(next);
      const double cost = problem.cost(next, there, whitening);
      if (!(cost < out.cost)) continue;
      fell = true;
      out.cost = cost;
      out.state = next;
      out.heights = std::move(there);
    }
    // stepᵀ H step = stepᵀ right.
    if (!fell || share * share * step.dot(equations.right) < kSmallStep) break;
  }
  return out;
}

bool shows_facets(const Refinement& problem, const Refined& at) {
  constexpr double kSigmas = 2.0, kRound = 0.5;  // of the bulge: nearer to the facets than to the round surface
  constexpr double kOfEdge = 0.25;               // two standard deviations are half an edge
  if (!std::isfinite(at.cost) || at.information.rows() == 0) return false;
  const Eigen::Index bulge = problem.bulge_at();
  const double bulge_sigma = std::sqrt(inverse_columns(at.information, bulge, 1)(bulge, 0));
  if (!(at.state.bulge + kSigmas * bulge_sigma < kRound)) return false;
  const PathChain& chain = problem.chain();
  for (std::size_t k = 0; k < chain.placement_count; ++k) {
    const auto first = 6 * static_cast<Eigen::Index>(k);
    const Matrix6 covariance = inverse_columns(at.information, first, 6).middleRows<6>(first);
    double square_m2 = 0.0, count = 0.0;
    for (std::size_t i = 0; i < at.heights.usable.size(); ++i) {
      if (at.heights.usable[i] == 0 || chain.parts[chain.part_of[i]].placement != k) continue;
      Eigen::Matrix<double, 3, 6> motion;
      motion << -skew(at.heights.p_mesh_m[i] - problem.centre_m(k)), Eigen::Matrix3d::Identity();
      square_m2 += (motion * covariance * motion.transpose()).trace();
      count += 1.0;
    }
    if (!(std::sqrt(square_m2 / std::max(1.0, count)) < kOfEdge * at.heights.edge_m)) return false;
  }
  return true;
}

Eigen::MatrixXd inverse_columns(const Eigen::SparseMatrix<double>& information, Eigen::Index first,
                                Eigen::Index count) {
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(information.rows(), count);
  for (Eigen::Index k = 0; k < count; ++k) columns(first + k, k) = 1.0;
  const Factor factor(information);
  if (factor.info() != Eigen::Success)
    return Eigen::MatrixXd::Constant(information.rows(), count, std::numeric_limits<double>::quiet_NaN());
  return factor.solve(columns);
}

}  // namespace asperity::registration
