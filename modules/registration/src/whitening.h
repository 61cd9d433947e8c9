#pragma once

#include <vector>

#include "path_chain.h"
#include "relief_level.h"

namespace asperity::registration {

// w_i = d_i + Σ a_k d_{i−k} has the variance `variance_m2` and no correlation along the path.
struct Whitening {
  std::vector<double> a;  // a[k - 1] is a_k
  double variance_m2 = 0.0;
  ReliefLevel level;  // of the heights without their long waves
};

// Yule–Walker from the heights' autocovariance over unbroken stretches, with Parzen's window, which keeps it
// positive definite (Levinson's and Durbin's recursion). What is longer than `smooth` points on either side is
// taken off first: it is the misfit that is looked for, not relief. One filter a path, from its own heights: textures
// differ.
std::vector<Whitening> make_whitenings(const PathChain& chain, const FacetHeights& heights, std::size_t order,
                                       std::size_t smooth);

}  // namespace asperity::registration
