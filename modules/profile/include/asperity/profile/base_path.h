#pragma once

#include <vector>

#include <Eigen/Core>

namespace asperity {

// The scan path without the surface's fine motion: for each motion sample the nearest point of the
// base shape, the outward unit normal there and the arc length up to it (seed §1.4, erratum 23).
struct BasePath {
  std::vector<Eigen::Vector3d> p_world_m;
  std::vector<Eigen::Vector3d> n_world;
  std::vector<double> s_m;

  std::size_t size() const { return p_world_m.size(); }
};

}  // namespace asperity
