#pragma once

#include <vector>

#include "asperity/geometry/pose.h"

namespace asperity {

// Poses between the tracker's, by the cubic through the four nearest (Lagrange); rotations as rotation vectors from the
// second of them, exact to the fourth order of the frame interval.
class PoseInterpolator {
 public:
  // Keeps a reference to `poses`; times rise strictly, at least four.
  PoseInterpolator(std::vector<double> t_s, const std::vector<Pose>& poses);

  // The rows' span; outside, the first or last cubic is continued.
  double first_s() const { return t_s_.front(); }
  double last_s() const { return t_s_.back(); }
  // `hint` is kept by the caller, beginning at 0; times that rise are found without a search.
  Pose at(double t_s, std::size_t& hint) const;

 private:
  std::vector<double> t_s_;
  const std::vector<Pose>& poses_;
};

}  // namespace asperity
