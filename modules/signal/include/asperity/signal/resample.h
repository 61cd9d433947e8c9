#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace asperity {

// Linear interpolation of the samples (t, x) at `count` points start + i·spacing. t must not fall (where
// it stands still the later sample counts); x may hold nan. A point outside [t.front(), t.back()], one
// with a nan neighbour it is not exactly on, and one inside a step of t wider than `max_step` is nan.
// t and start share one unit. Throws Error if the sizes differ, t falls or is nan, or spacing is not
// positive.
std::vector<double> resample_uniform(std::span<const double> t, std::span<const double> x, double start, double spacing,
                                     std::size_t count, double max_step = std::numeric_limits<double>::infinity());

// The same at rising points `at`. Throws Error if they fall.
std::vector<double> interpolate(std::span<const double> t, std::span<const double> x, std::span<const double> at,
                                double max_step = std::numeric_limits<double>::infinity());

// The mean of the linear interpolation over [at - width/2, at + width/2], as far as the samples reach: what
// lies above half of the new rate is averaged instead of folded into it, and the integral is kept. x must
// be finite. Throws Error as above, or if the width is not positive or an interval is outside the samples.
std::vector<double> interval_means(std::span<const double> t, std::span<const double> x, std::span<const double> at,
                                   double width);

// x with each run of nan replaced by the straight line between its neighbours over t, and by the nearest
// value at the ends; all nan if no sample is finite. Throws Error as above.
std::vector<double> bridge_gaps(std::span<const double> t, std::span<const double> x);

// The same for evenly spaced samples.
std::vector<double> bridge_gaps(std::span<const double> x);

}  // namespace asperity
