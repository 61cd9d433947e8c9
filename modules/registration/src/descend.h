#pragma once

#include <limits>
#include <span>
#include <vector>

#include "iteration_watch.h"
#include "refinement.h"

namespace asperity::registration {

// Where Gauss–Newton ended.
struct Refined {
  State state;
  FacetHeights heights;
  Eigen::SparseMatrix<double> information;  // its lower triangle; empty: there were too few points
  double cost = std::numeric_limits<double>::infinity();
  int iterations = 0;
};

// Gauss–Newton with one filter a path, from one state. Each step is halved until the cost falls.
Refined descend_to_minimum(const Refinement& problem, const State& start, std::span<const Whitening> whitening,
                           int max_iterations, IterationWatch& watch);

// Columns of the inverse of an information matrix: those of the unknowns `first` to `first + count`. nan where it is
// singular.
Eigen::MatrixXd inverse_columns(const Eigen::SparseMatrix<double>& information, Eigen::Index first, Eigen::Index count);

// Some filter has a variance: not all paths lie on the mesh exactly.
bool has_variance(std::span<const Whitening> whitening);

}  // namespace asperity::registration
