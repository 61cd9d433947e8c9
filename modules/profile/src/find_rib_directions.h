#pragma once

#include <span>
#include <vector>

#include "asperity/profile/find_periodicity.h"
#include "asperity/profile/texture_noise.h"
#include "bent_path.h"

namespace asperity {

struct RibDirection {
  double tangent = 0.0;  // of the angle between the ribs' normal and the chord
  double sigma = 0.0;    // its standard deviation, the Cramér–Rao bound of a wave of such a power
};

struct RibDirections {
  double range = 0.0;  // of the tangents that were searched
  std::vector<RibDirection> best;
};

// The directions of ribs along whose normal a wave of the heights (m, nan in gaps) stands out most of the waves beside
// it, at most four, the best first: candidates, for LineSearch to judge. Searched are tangents of −1 to 1 that the path
// crosses one way, in steps of half a period of the shortest wave over the bend. Heights times directions are at most
// 2^25: where the bend is larger than 8.4e6 shortest waves over the number of heights (250 mm for 0.3 mm and 10,000
// heights), only longer waves are searched.
// A wave of the frequency f whose ordinate is r times the density about it determines the tangent to
// 1/(2π f b √(2r)), b the path's RMS bend.
RibDirections find_rib_directions(const BentPath& path, std::span<const double> height_m, double spacing_m,
                                  const TextureNoise& noise, const PeriodicityConfig& config);

}  // namespace asperity
