#include "descend.h"

#include <algorithm>
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
                           int max_iterations, IterationWatch& watch) {
  watch.next_start();
  Refined out;
  out.state = start;
  out.heights = problem.heights(start);
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
