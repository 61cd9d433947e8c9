#pragma once

#include <limits>
#include <string_view>

#include "asperity/json/json_object.h"
#include "asperity/json/json_writer.h"

namespace asperity {

inline constexpr double kLargestNumber = std::numeric_limits<double>::max();
// Larger heights are a mistake of unit, and their sums could overflow.
inline constexpr double kLargestHeight_m = 1e3;
inline constexpr Range kHeights_m{-kLargestHeight_m, kLargestHeight_m};
inline constexpr std::size_t kMostCoefficients = 65536;
inline constexpr std::size_t kLongestText_bytes = 4096;

// How a texture's file is laid out: one key a line, the model's block two levels deep.
inline constexpr JsonStyle kTextureStyle{2, false};
inline JsonWriter block_writer() { return JsonWriter(kTextureStyle, 1); }

}  // namespace asperity
