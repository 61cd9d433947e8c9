#pragma once

#include <span>

namespace bench {

// The pitch of a pattern in error of a known spectrum, by one who is not told where to look: nan if the texture is
// shorter than three of the shortest pitches. `error_m` has that spectrum; both m, nan in gaps, of equal length.
//
// Over all pitches of the product's search (0.3 to 10 mm, at most a third of the texture), the sum over the harmonics
// up to 8 cycles/mm of what the periodogram has more than 8 times the error's density, which noise has in one of 3000
// frequencies: the log likelihood ratio of the waves that stand out. Multiples of a pitch hold the same waves and no
// more: of all pitches whose sum is within 8 and 2 % of the highest the shortest is taken.
double find_unknown_pitch_m(std::span<const double> texture_m, std::span<const double> error_m, double spacing_m);

}  // namespace bench
