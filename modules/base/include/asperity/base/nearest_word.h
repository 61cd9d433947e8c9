#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace asperity {

// The word of `known` that `typed` was most likely meant to be: by the fewest letters exchanged, left out, added or
// swapped with their neighbour (restricted Damerau-Levenshtein distance), at most `most`, and fewer than half of the
// letters; or the only one that begins with it. Empty if there is none.
std::string nearest_word(std::string_view typed, const std::vector<std::string>& known, std::size_t most = 2);

}  // namespace asperity
