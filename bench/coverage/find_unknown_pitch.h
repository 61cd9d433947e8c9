#pragma once

#include <span>

namespace bench {

// The pitch of a pattern in error of a known spectrum, by one who is not told where to look: nan if the texture is
// shorter than three of the shortest pitches. `error_m` has that spectrum; both m, nan in gaps, of equal length.
//
// Over all pitches of the product's search (0.3 to 10 mm, at most a third of the texture), the power of the first four
// harmonics that stands out of the error: the periodogram less what the error's density exceeds anywhere in the search
// with 1 %. Multiples of a pitch hold the same waves: of all pitches within 2 % of the highest power the shortest is
// taken.
double find_unknown_pitch_m(std::span<const double> texture_m, std::span<const double> error_m, double spacing_m);

}  // namespace bench
