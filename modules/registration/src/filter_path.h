#pragma once

#include <cstddef>
#include <span>

#include <Eigen/Core>

#include "asperity/registration/weigh_poses.h"
#include "path_blocks.h"

namespace asperity::registration {

using Vector10 = Eigen::Matrix<double, 10, 1>;
using Matrix10 = Eigen::Matrix<double, 10, 10>;

// The mean height of a block over the mesh at a pose.
struct BlockHeight {
  double d_m = 0.0;
  Vector10 row = Vector10::Zero();  // its derivatives by pose, log_size and the tip's position
  Eigen::Vector3d n_world = Eigen::Vector3d::Zero();
  bool usable = false;
};

// Sums over blocks; of the first kRows unknowns of BlockHeight::row.
template <int kRows>
struct FilterSums {
  double cost = 0.0;  // −2 log likelihood
  Eigen::Matrix<double, kRows, kRows> information = Eigen::Matrix<double, kRows, kRows>::Zero();
  Eigen::Matrix<double, kRows, 1> gradient = Eigen::Matrix<double, kRows, 1>::Zero();
  std::size_t outlying = 0;  // blocks
};

// Kalman's filter along a path, added to `out`; its state is the slow error, a Gauss–Markov process along the path, and
// the mean of the relief. The columns of the Jacobian go through the same filter as the heights, whose gains they
// share: what comes out is whitened. `slow_ratio`: of the slow error's standard deviation over the stated one;
// `noise_m`: of a block's mean. For 0, 6, 7 and 10 rows.
template <int kRows>
void filter_path(const PathBlocks& blocks, std::size_t path_number, std::span<const BlockHeight> heights,
                 double slow_ratio, double noise_m, const WeighConfig& config, FilterSums<kRows>& out);

}  // namespace asperity::registration
