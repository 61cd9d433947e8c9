#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "asperity/registration/weigh_poses.h"
#include "point_set.h"
#include "relief_scale.h"

namespace asperity::registration {

// Of paths without stated errors a priori: the drift over the points' radius, and what its logarithm is known to.
inline constexpr double kUnstatedDrift = 2e-3, kUnstatedSpread = 1.5;

// The paths, divided into blocks over which heights are averaged (weigh_poses.h).
struct PathBlocks {
  struct Path {
    Eigen::Matrix3d covariance_m2 = Eigen::Matrix3d::Zero();  // of its slow error
    ReliefScale relief;
    std::size_t first = 0, count = 0;  // of the blocks
  };
  struct Block {
    double s_m = 0.0;
    std::size_t first = 0, count = 0;  // of the chosen points
  };
  std::vector<Path> paths;
  std::vector<Block> blocks;          // path after path
  std::vector<std::uint32_t> chosen;  // points of each block, evenly spread over it, one block after the other
  bool stated = true;                 // the slow errors' covariances are known
};

PathBlocks divide_into_blocks(std::span<const MeasuredPath> paths, const PointSet& points, const WeighConfig& config);

}  // namespace asperity::registration
