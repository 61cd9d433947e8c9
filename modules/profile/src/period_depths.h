#pragma once

#include <span>
#include <vector>

namespace asperity {

// Highest less lowest value of each whole period (in points), where at most 30 % of it is missing.
std::vector<double> period_depths(std::span<const double> x, double period);

}  // namespace asperity
