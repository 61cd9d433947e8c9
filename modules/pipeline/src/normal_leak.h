#pragma once

#include <span>
#include <vector>

#include "asperity/geometry/motion.h"
#include "asperity/profile/base_path.h"

namespace asperity {

// The tip's place across the path (along one direction, off its first place) and along the normal, off the base.
struct OffBase {
  std::vector<double> sway_m;
  std::vector<double> rise_m;
};
OffBase off_base(const TipMotion& motion, const BasePath& base);

// By how much of the sway the rise goes, where that is no chance: the tangent of a normal's error about the direction
// of travel. A hand's tremor (3 to 15 Hz) has nothing to do with the surface, so a rise that goes with it shows a base
// whose normal leans. 0 where the correlation's Student t is within 4 of none, by as many degrees of freedom as
// Bartlett's variance leaves (the sum of the products of both autocorrelations), or the samples with `moving` set last
// less than 1.6 s.
double normal_leak(const TipMotion& motion, const OffBase& off, std::span<const char> moving);

}  // namespace asperity
