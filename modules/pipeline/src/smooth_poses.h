#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "pose_path.h"

namespace asperity {

// The poses' noise at the tip: white, and a slow part whose correlation falls as exp(−Δt/time).
struct PoseNoise {
  Eigen::Vector3d white_m = Eigen::Vector3d::Zero(), slow_m = Eigen::Vector3d::Zero();
  double slow_time_s = 1.0;
};

// A path smoothed by local parabolas: position, velocity, and what noise of unit size becomes in them: standard
// deviation over that of a pose.
struct SmoothedPoses {
  std::vector<Eigen::Vector3d> p_m;
  std::vector<Eigen::Vector3d> v_mps;
  std::vector<double> p_white, p_slow;              // of p
  std::vector<double> v_white_per_s, v_slow_per_s;  // of v

  Eigen::Vector3d p_sigma_m(std::size_t i, const PoseNoise& noise) const {
    return (p_white[i] * p_white[i] * noise.white_m.cwiseAbs2() + p_slow[i] * p_slow[i] * noise.slow_m.cwiseAbs2())
        .cwiseSqrt();
  }
  // The mean of the axes.
  double v_sigma_mps(std::size_t i, const PoseNoise& noise) const {
    return std::hypot(v_white_per_s[i] * noise.white_m.norm(), v_slow_per_s[i] * noise.slow_m.norm()) / std::sqrt(3.0);
  }
};

// How much of the slow noise each pose has in common with the one before: exp(−Δt/time).
std::vector<double> decay_between(const std::vector<double>& t_s, double time_s);

// By parabolas with the weights (1 − u²)² over `half_width_s` to either side, u from −1 to 1; over more where fewer
// than five poses are that near. `decay` is that of the path's times.
SmoothedPoses smooth_poses(const PosePath& path, double half_width_s, const std::vector<double>& decay);

}  // namespace asperity
