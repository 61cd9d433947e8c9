#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "asperity/base/config.h"

namespace asperity {

struct ComparisonConfig {
  double low_cycles_per_mm = 0.15;
  double high_cycles_per_mm = 4.0;
  double max_shift_m = 3e-3;
  double spacing_m = 0.025e-3;
  double bridge_m = 0.5e-3;
  double margin_m = 3e-3;
  double bridge_margin_m = 0.5e-3;
  double max_hole_m = 0.6e-3;

  template <class V>
  void visit(V& v) {
    v.field("low_cycles_per_mm", low_cycles_per_mm, "lower edge of the compared band, -3 dB", {1e-4, 20.0});
    v.field("high_cycles_per_mm", high_cycles_per_mm, "upper edge of the compared band, -3 dB", {1e-3, 20.0});
    v.field("max_shift_m", max_shift_m, "largest rigid shift between the two", {0.0, 1.0});
    v.field("spacing_m", spacing_m, "at which both are compared", {1e-7, 1e-2});
    v.field("bridge_m", bridge_m, "gap across which the band-pass continues", {0.0, 1.0});
    v.field("margin_m", margin_m, "left out next to ends and gaps that were not bridged", {0.0, 1.0});
    v.field("bridge_margin_m", bridge_margin_m, "left out next to bridged gaps", {0.0, 1.0});
    v.field("max_hole_m", max_hole_m, "distance between samples that is still interpolated", {1e-7, 1.0});
  }
};

// min(4, 0.4·rate/speed) cycles/mm: the upper edge of the band in which profiles are compared.
double comparison_limit_cycles_per_mm(double rate_hz, double speed_mps);

struct ProfileComparison {
  double correlation = std::numeric_limits<double>::quiet_NaN();
  double gain = std::numeric_limits<double>::quiet_NaN();    // slope of the regression of measured on true
  double rms_um = std::numeric_limits<double>::quiet_NaN();  // RMS difference of the band-passed heights
  double true_rms_um = std::numeric_limits<double>::quiet_NaN();
  double shift_m = 0.0;  // to add to the measured s for it to lie on the true one
  double length_error_percent = std::numeric_limits<double>::quiet_NaN();  // of the measured span over the true one
  double compared_m = 0.0;                                                 // length that entered
};

// The heights that were compared, point by point on one grid, both band-passed; nan where a side has none.
struct ComparedHeights {
  std::vector<double> s_m;  // along the true profile
  std::vector<double> measured_m;
  std::vector<double> true_m;
};

struct AlignedProfiles {
  ProfileComparison comparison;
  ComparedHeights heights;  // empty where the comparison stays nan
};

// Compares a measured with a true profile, each given by arc length and height (m); s may be irregular, dwell
// or repeat, and heights may be nan. Both are resampled alike (resample_over_path.h), band-passed alike
// (second-order Butterworth, zero phase, -3 dB of the whole filter at the band's edges), and compared over
// their common span after the one rigid shift that gives the highest correlation: searched over the grid,
// then refined below it by a parabola and applied by the resampling of the measured side. Where the measured side
// has a gap, the true one is given the same. The length
// error compares the spans from first to last finite height, so both must cover the same motion.
// Throws Error for a band or shift out of range, or if a side has fewer than 8 finite heights. Where the
// overlap is shorter than ten points, the results stay nan.
AlignedProfiles align_profiles(std::span<const double> measured_s_m, std::span<const double> measured_height_m,
                               std::span<const double> true_s_m, std::span<const double> true_height_m,
                               const ComparisonConfig& config);

// Its figures alone.
ProfileComparison compare_profiles(std::span<const double> measured_s_m, std::span<const double> measured_height_m,
                                   std::span<const double> true_s_m, std::span<const double> true_height_m,
                                   const ComparisonConfig& config);

}  // namespace asperity
