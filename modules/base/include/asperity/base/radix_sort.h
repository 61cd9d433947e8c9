#pragma once

#include <cstdint>
#include <vector>

namespace asperity {

// Sorts by digits of 11 bits from the lowest on (Knuth, The Art of Computer Programming, vol. 3, §5.2.5): on a hundred
// thousand numbers a tenth of the work of sorting by comparison. Of long vectors only; short ones are compared.
void radix_sort(std::vector<std::uint64_t>& values);

// The largest first. No value may be nan.
void sort_falling(std::vector<double>& values);

}  // namespace asperity
