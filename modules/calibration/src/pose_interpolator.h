#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include "asperity/geometry/pose.h"

namespace asperity {

// Poses between the tracker's, by the cubic through the four nearest (Lagrange); rotations as rotation vectors from the
// second of them, exact to the fourth order of the frame interval.
class PoseInterpolator {
 public:
  // Where the last question was answered: times that rise are found without a search, and the rotation vectors of an
  // interval are made once.
  struct Cursor {
    std::size_t row = 0;
    std::size_t first = std::numeric_limits<std::size_t>::max();
    std::array<Eigen::Vector3d, 4> turns;  // from the second of the four poses
  };

  // Keeps a reference to `poses`; times rise strictly, at least four.
  PoseInterpolator(std::vector<double> t_s, const std::vector<Pose>& poses);

  // The rows' span; outside, the first or last cubic is continued.
  double first_s() const { return t_s_.front(); }
  double last_s() const { return t_s_.back(); }
  Pose at(double t_s, Cursor& cursor) const;

 private:
  std::vector<double> t_s_;
  const std::vector<Pose>& poses_;
};

}  // namespace asperity
