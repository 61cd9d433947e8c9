#pragma once

#include <span>

namespace asperity {

struct Interval {
  double low = 0.0;
  double high = 0.0;
};

// The 95 % interval of a probability after `successes` of `trials` (Wilson 1927); 0 to 1 without trials.
Interval wilson_interval(double successes, double trials);

struct MeanOfRatings {
  double mean = 0.0;
  double deviation = 0.0;  // sample standard deviation
  Interval interval;       // of the mean, 95 %, by Student's t; the whole scale for fewer than two
};

// `values` is not empty. The interval is cut off at the ends of the scale.
MeanOfRatings mean_of_ratings(std::span<const int> values, Interval scale);

}  // namespace asperity
