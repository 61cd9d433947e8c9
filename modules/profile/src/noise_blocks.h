#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "asperity/profile/profile.h"

namespace asperity {

// Points over which speeds and errors are taken together: 0.5 mm.
struct Block {
  std::size_t first = 0, last = 0;  // points
  double points = 0.0;              // of them with a height
  double speed_mmps = 0.0;
};

// Mean squares of drawn errors: over all points that have a texture, in each block, and how much one draw's differs
// from the mean's, relative.
struct BlockErrors {
  double power_m2 = 0.0, spread = 0.0;
  std::vector<double> block_m2;
};

double mean_square(std::span<const double> x);  // of those that are present; nan without any

// The blocks of the profile that have heights. Single points beside gaps may have no speed: theirs is the last known.
std::vector<Block> find_blocks(const Profile& profile);
BlockErrors over_blocks(const Profile& profile, const std::vector<Block>& blocks,
                        const std::vector<std::vector<double>>& draws);
std::vector<std::vector<double>> difference(std::vector<std::vector<double>> a,
                                            const std::vector<std::vector<double>>& b);
// Marks the blocks without the tenth whose noise is largest.
std::vector<char> without_noisiest(const std::vector<Block>& blocks, const std::vector<double>& noise_m2);
double mean_over(const std::vector<Block>& blocks, const std::vector<char>& takes, const std::vector<double>& value);
std::vector<double> squares_of(const std::vector<double>& x, const std::vector<Block>& blocks);

}  // namespace asperity
