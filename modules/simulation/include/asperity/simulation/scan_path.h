#pragma once

#include <vector>

#include "asperity/base/random.h"
#include "asperity/simulation/hand_config.h"

namespace asperity {

// A point of the path on the base shape: coordinates as in base_shape.h, and the angle of the path's
// direction from the main direction of the stroke towards `across`.
struct ScanPoint {
  double a_m = 0.0;
  double v_m = 0.0;
  double angle_rad = 0.0;
};

// The path that the hand means to follow on the base shape, by its own arc length: straight, an arc, or
// strokes back and forth joined by smooth bends, with a slow random deviation. It continues straight
// beyond both ends. This arc length is the truth's `s_m` (erratum 23).
class ScanPath {
 public:
  ScanPath(const HandConfig& config, Random& random);

  double length_m() const { return length_m_; }
  ScanPoint at(double s_m) const;

 private:
  std::vector<ScanPoint> nodes_;  // evenly spaced from s = 0
  double length_m_ = 0.0;
};

}  // namespace asperity
