#pragma once

#include <span>

namespace bench {

// Whether the heights have more power at the first four harmonics of a pitch than a random surface has anywhere in the
// search for a pitch (0.3 to 10 mm), with a probability of 1 %.
//
// A pitch that is the same in every twin of the noise is one that the noise has not made. It may still be of a random
// surface, which is the same in all twins: without noise every random surface has its highest ordinate at the same
// frequency each time. Of a stationary random surface the ordinates of the periodogram are exponentially distributed
// about its density S. Either one of the four is too rare for that, or their rarities (−ln of the probability that one
// is as high) add up to too much; both may err in ½ %. Over K of N independent frequencies a sum T of rarities has the
// probability N m T^(K − ½) e^(−T)/(K − 1)!, m² the mean square of the K harmonics' numbers (Davies, Biometrika 74,
// 1987, for 2K degrees of freedom). S is the median over the neighbours of each harmonic, over ln 2, whose logarithm
// has the variance v: the rarity of R times S is (1/v) ln(1 + v R).
bool exceeds_random_surface(std::span<const double> texture_m, double spacing_m, double pitch_m);

}  // namespace bench
