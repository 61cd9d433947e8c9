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

// Whether the kinks at the facets' edges tell where along the mesh the paths are (path_chain.h).
enum class FacetKinks { kIgnored, kCounted };

// Gauss–Newton with one filter a path, from one state. Each step is halved until the cost falls.
Refined descend_to_minimum(const Refinement& problem, const State& start, std::span<const Whitening> whitening,
                           int max_iterations, IterationWatch& watch, FacetKinks kinks = FacetKinks::kIgnored);

// Whether the heights show by themselves that the object has the mesh's facets, and each pose is known without their
// kinks to well within an edge, so that it is clear which kink is which.
bool shows_facets(const Refinement& problem, const Refined& at);

// Columns of the inverse of an information matrix: those of the unknowns `first` to `first + count`. nan where it is
// singular.
Eigen::MatrixXd inverse_columns(const Eigen::SparseMatrix<double>& information, Eigen::Index first, Eigen::Index count);

// Some filter has a variance: not all paths lie on the mesh exactly.
bool has_variance(std::span<const Whitening> whitening);

}  // namespace asperity::registration
