#pragma once

#include <span>
#include <vector>

namespace asperity {

// Tukey's biweight as the robust filters of ISO 16610 take it.

// Distances from which on a height counts for nothing: 4.4478 times the median of all distances; 0 without any.
double biweight_limit(std::vector<double> distances);

// The least limit that means anything: 1e-10 of the largest height, below which distances are rounding. Where it is the
// limit the heights that lie on the mean are found from one iteration to the next, so that the filter goes on until
// none is added.
double least_biweight_limit(std::span<const double> heights);

// Part of a whole weight's sum below which the rounding of transforms, which is that of all heights in reach, could
// decide.
inline constexpr double kLittleTrust = 0.05;

// (1 − (r/c)²)² within |r| < c, else 0.
double biweight(double distance, double limit);

}  // namespace asperity
