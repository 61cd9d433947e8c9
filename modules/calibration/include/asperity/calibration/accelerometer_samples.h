#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace asperity {

// Raw readings of a three-axis accelerometer. `specific_force_mps2` is empty, or f = a − g in the marker frame at each
// reading, known from elsewhere. Times rise strictly.
struct AccelerometerSamples {
  std::vector<double> t_s;
  std::vector<Eigen::Vector3d> counts;
  std::vector<Eigen::Vector3d> specific_force_mps2;

  std::size_t size() const { return t_s.size(); }
  bool force_known() const { return !specific_force_mps2.empty(); }
};

}  // namespace asperity
