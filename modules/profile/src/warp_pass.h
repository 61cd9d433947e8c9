#pragma once

#include <span>
#include <vector>

#include "asperity/profile/align_passes.h"
#include "pass_signal.h"

namespace asperity {

// Heights on the common grid with the density of their noise.
struct WarpTarget {
  std::vector<double> height_m;
  std::vector<char> known;
  std::vector<double> frequency, noise;  // cycles/mm, one-sided
  bool states_noise = true;              // all passes of it state theirs
};

struct WarpPrior {
  double place_sigma_mm = 0.05;  // of a knot
  double knot_spacing_mm = 5.0;
};

struct WarpedPlaces {
  std::vector<double> places;
  bool converged = false;  // else the equations had no solution, or led away from the target: not to be used
};

// Places in `pass`, in points of its heights, of the target's points, by maximum likelihood from the places that are
// given (docs/merge.md): shift, stretch and knots by Gauss and Newton on the difference of the two, whitened by the
// density of both noises; the knots have a prior. The first steps see long waves alone. A step that makes the fit worse
// is halved. Where one of the two states no noise, the density is at least that of the difference of the two as it is
// laid: otherwise what is noise alone would count as heights, and the knots would follow it. Throws Error for more
// points and knots than the equations can have (2²⁶ numbers).
WarpedPlaces warp_pass(const WarpTarget& target, const PassSignal& pass, std::span<const double> places,
                       const WarpPrior& prior, const AlignPassesConfig& config);

}  // namespace asperity
