#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace asperity {

// How many points `spacing_m` apart go into `length_m`, both ends included. Throws Error, before anybody takes
// memory for them, for more than ten million (250 m at 0.025 mm): positions that jump about are no scan.
std::size_t count_points(double length_m, double spacing_m);

// Samples of several channels over arc length, in order of s and with near ones averaged.
struct PathKnots {
  std::vector<double> s_m;                    // rises strictly
  std::vector<std::vector<double>> channels;  // each as long as s_m; the mean of a knot's finite values, else nan
};

// Sorts the samples with `usable` set (empty: all) by s and averages those within `cell_m` of each other, so
// that dwells and small steps back become one knot. Samples whose s or first channel is not finite are
// left out. Throws Error if the sizes differ or cell_m is not positive.
PathKnots gather_knots(std::span<const double> s_m, std::span<const std::span<const double>> channels,
                       std::span<const char> usable, double cell_m);

// The knots' first channel at s = (first + i)·spacing_m, i < count: a natural cubic spline through the knots,
// sampled four times as finely, then a linear-phase low-pass (gain within 0.1 % of 1 up to a fifth of the
// rate 1/spacing_m, 1/2 at 0.4 of it, below 0.1 % from 0.6 on), so that finer detail does not fold into
// the profile. Knots sparser than the spacing are interpolated. nan outside the knots and in holes wider
// than max_hole_m. For the spline not to see noise as slope the knots should be a quarter of the spacing
// apart (gather_knots with cell_m = spacing_m/4).
std::vector<double> resample_smooth(const PathKnots& knots, std::ptrdiff_t first, std::size_t count, double spacing_m,
                                    double max_hole_m);

// Any channel by linear interpolation between its finite knots, with the same holes.
std::vector<double> resample_linear(const PathKnots& knots, std::size_t channel, std::ptrdiff_t first,
                                    std::size_t count, double spacing_m, double max_hole_m);

}  // namespace asperity
