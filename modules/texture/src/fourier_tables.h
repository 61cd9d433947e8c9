#pragma once

#include "asperity/texture/fourier1d.h"

namespace asperity {

// Of RMS, as promised by servo_height().
inline constexpr double kTableHeightError = 1e-6;
inline constexpr double kTableSlopeError = 1e-4;

// What bounds and measures a series: the means are over a period.
struct SeriesSize {
  double mean = 0.0;
  double rms_m = 0.0;  // about the mean
  double rms_slope = 0.0;
  double most_m = 0.0;      // bounds |g|
  double most_slope = 0.0;  // bounds |g'|
};

SeriesSize size_of(const Fourier1d& f);

}  // namespace asperity
