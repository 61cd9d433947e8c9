#pragma once

#include <string_view>
#include <vector>

namespace asperity {

// The units of length that parse_length_m() and parse_length_unit_m() of units.h read, each under one name in ASCII:
// "m", "cm", "mm", "um", "nm".
std::vector<std::string_view> length_unit_names();

}  // namespace asperity
