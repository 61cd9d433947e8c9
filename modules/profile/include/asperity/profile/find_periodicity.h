#pragma once

#include <cstddef>
#include <limits>
#include <span>

#include "asperity/base/config.h"

namespace asperity {

struct PeriodicityConfig {
  double min_pitch_m = 0.3e-3;
  double max_pitch_m = 10e-3;
  double min_strength = 0.3;

  template <class V>
  void visit(V& v) {
    v.field("min_pitch_m", min_pitch_m, "shortest period that is looked for", {1e-6, 1.0});
    v.field("max_pitch_m", max_pitch_m, "longest period that is looked for", {1e-6, 1.0});
    v.field("min_strength", min_strength, "autocorrelation from which a texture counts as periodic", {0.0, 1.0});
  }
};

struct Periodicity {
  bool periodic = false;
  double pitch_m = std::numeric_limits<double>::quiet_NaN();
  double pitch_stderr_m = std::numeric_limits<double>::quiet_NaN();
  double depth_m = std::numeric_limits<double>::quiet_NaN();  // median peak-to-valley of the periods
  double depth_stderr_m = std::numeric_limits<double>::quiet_NaN();
  double strength = 0.0;    // autocorrelation at one pitch, in [-1, 1]
  std::size_t periods = 0;  // whole ones that entered the depth
  // Across the ribs and not along the path; nan unless the path's bend was needed to find them (docs/periodicity.md).
  double across_pitch_m = std::numeric_limits<double>::quiet_NaN();
  double across_pitch_stderr_m = std::numeric_limits<double>::quiet_NaN();
  // Straight ribs repeat in x + t y of the unrolled path, y to the left of its chord x: t. nan as above, and of
  // lattices.
  double rib_tangent = std::numeric_limits<double>::quiet_NaN();
};

// The dominant spatial period of a uniform profile (m, nan in gaps) and the depth of its pattern. The period is
// the shortest lag whose peak of the autocorrelation reaches 85 % of the highest, refined by the
// frequency at which its first four harmonics together have the most power, and then by the straight line
// through the fundamental's phase in windows of two periods. The standard error is that line's, with the
// residuals' autocorrelation allowed for, so an error of the arc length that comes and goes is in it; one
// that is constant is not. The depth is taken over periods of which at least 70 % are not gaps; its standard
// error is that of a median. `periodic` is false below `min_strength`, for fewer than three periods and where
// none of the first eight harmonics is a line nor the first two are a pair, as in one of a hundred random profiles
// (docs/periodicity.md); the rest is then as far as it could be had. Throws Error for a spacing or a range that makes
// no sense.
Periodicity find_periodicity(std::span<const double> height_m, double spacing_m, const PeriodicityConfig& config);

}  // namespace asperity
