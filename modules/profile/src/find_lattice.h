#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include <Eigen/Core>

#include "asperity/profile/find_periodicity.h"
#include "asperity/profile/texture_noise.h"
#include "bent_path.h"

namespace asperity {

// A square lattice under a bent path, as the holes of a board: the waves m b + n b⊥ for whole m and n, b its first wave
// vector and b⊥ that turned by 90°.
struct Lattice {
  Eigen::Vector2d wave_per_m = Eigen::Vector2d::Zero();  // b, within 45° of the chord
  double relative_sigma = 0.0;                           // of its period 1/|b|, the Cramér–Rao bound
};

// The lattice whose waves (1,0), (0,1), (1,1) and (1,−1) stand out most of what is beside them, where a random surface
// has such a one with a probability of at most `chance` anywhere in the search; none otherwise. Periods are looked for
// from √2 times the shortest pitch, so that all four waves are in the band, to the longest or an eighth of the chord;
// the shortest rises with the length of paths beyond about 0.4 m, so that at most 2^25 places are searched.
//
// The statistic is T = Σ q, q the exponent of each wave's rarity (plane_waves.h). Of a random surface each is
// exponential, so 2T is χ² with 2K = 8 degrees of freedom, a random field over b. The highest of it exceeds 2T with
// (Adler and Taylor, Random Fields and Geometry, 15.10)
//
//   Q(K, T) + √λ l ρ₁(2T) + λ A ρ₂(2T)
//
// A and 2l the area and the border of the quarter of a ring that b is in, λ the mean over the waves of the variance of
// their phase's slope in b, (2π)² (m² + n²) (σ_x² + σ_y²)/2, σ of the path's points.
// Ribs have one strong wave and a lattice more than one: without the strongest the others must be rare too, where it
// has put them. Together they hold at least an eighth of the heights' power without noise.
std::optional<Lattice> find_lattice(const BentPath& path, std::span<const double> height_m, double spacing_m,
                                    const TextureNoise& noise, double most_noise, const PeriodicityConfig& config,
                                    double chance);

}  // namespace asperity
