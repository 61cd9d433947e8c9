#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace asperity {

// Where a device point goes, in the scene's world: straight from each point to the next.
struct DevicePath {
  std::vector<std::int64_t> t_ns;  // from 0, rising
  std::vector<Eigen::Vector3d> p_world_m;

  std::size_t size() const { return t_ns.size(); }
};

// The interval of rising times that `t_ns` falls in, and where: t[index] <= t, share in [0, 1); the first or last
// time outside of them. `hint` is the index of the query before; queries that rise cost nothing.
struct TimeIndex {
  std::size_t index = 0;
  double share = 0.0;
};
TimeIndex find_time(const std::vector<std::int64_t>& times_ns, std::int64_t t_ns, std::size_t& hint);

// The point at a time; exactly a sample's own at its time.
Eigen::Vector3d position_at(const DevicePath& path, std::int64_t t_ns, std::size_t& hint);

}  // namespace asperity
