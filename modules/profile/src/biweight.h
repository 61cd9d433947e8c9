#pragma once

#include <vector>

namespace asperity {

// Tukey's biweight as the robust filters of ISO 16610 take it.

// Distances from which on a height counts for nothing: 4.4478 times the median of all distances; 0 without any.
double biweight_limit(std::vector<double> distances);

// (1 − (r/c)²)² within |r| < c, else 0.
double biweight(double distance, double limit);

}  // namespace asperity
