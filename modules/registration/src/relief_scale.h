#pragma once

#include <span>

#include <Eigen/Core>

namespace asperity::registration {

// The relief along a path, by the path alone, without a mesh or a pose.
struct ReliefScale {
  double block_m = 0.0;  // length of path over which its mean is known best
  double rms_m = 0.0;    // of a periodic relief; 0 for another
};

// The mean over a block of path of length L still has something of the relief. With r the path less what is longer,
// V(L) the variance of the means of r over L, and W(L) that which white noise of variance 1 would have there, V/W is
// the same for all L if the relief's correlation ends within the shortest. It has a deep minimum where L is a period of
// the relief: the means over half a period of a board's holes are in turn above and below the mean of all, those over a
// whole period are nearly equal. The block is that of least V/W from `shortest_m` to 2.5 times that, if this is less
// than a quarter of what the shortest has (a twelfth on paths of less than 25 shortest blocks); else the shortest. It
// depends on no pose, and so is the same at all that are compared.
//   r = (1 − M²)³ x,  M the moving mean over 2.5 `shortest_m`:
// waves of five times that length are left with 0.002 of their height, those of a period with 0.9 and more. Edges of
// the object are left in r; so of a relief without a period the RMS is not stated. Points of one path, about evenly
// spaced; with fewer than four a shortest block, or on a path of less than 20 shortest blocks, on which means are alike
// by chance, nothing is concluded: the shortest, and a relief of 0.
ReliefScale measure_relief(std::span<const Eigen::Vector3d> x_m, std::span<const double> s_m, double shortest_m);

}  // namespace asperity::registration
