#pragma once

#include <vector>

#include <Eigen/Core>

namespace asperity {

// Where the tracker's poses have the tip.
struct PosePath {
  std::vector<double> t_s;  // true time
  std::vector<Eigen::Vector3d> p_world_tip_m;
};

// The poses' white noise an axis (signal/white_noise.h); zero if there are too few.
Eigen::Vector3d white_noise_m(const PosePath& path);

// 1 for each pose that is far from the median of its neighbours in 0.15 s, in an axis. A steady motion, which spreads
// the neighbours, leaves their median at the pose.
std::vector<char> find_outlying_poses(const PosePath& path, const Eigen::Vector3d& sigma_m);

// The poses without those.
PosePath without_outliers(const PosePath& path, const Eigen::Vector3d& sigma_m);

}  // namespace asperity
