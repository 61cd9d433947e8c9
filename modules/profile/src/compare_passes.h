#pragma once

#include <span>
#include <vector>

#include "asperity/profile/align_passes.h"
#include "average_passes.h"
#include "split_differences.h"

namespace asperity {

// What passes on one grid show of their noise: by their differences, where all are known.
struct PassDifferences {
  // Nothing is determined (nan, empty) where they share less than a few segments.
  double ratio = kNan, ratio_low = kNan, ratio_high = kNan;  // power of the differences over what is stated
  SplitDifferences parts;
  std::vector<double> frequency_cycles_per_mm, scatter_psd_m2_mm;  // of a pass
  std::vector<double> noise_m2;                                    // of each pass, in the band; by Grubbs' estimates
  std::vector<double> stated_m2;      // the same as it is stated: added, misplaced, and the scale
  double independent_segments = 0.0;  // of the spectra
  std::vector<double> coherence;      // of each pass with the mean of the others, in the band
  // The two passes whose difference has the least power over their stated added noise: what neither alignment nor the
  // surface explains, and two measurements have each of its own.
  std::size_t closest_first = 0, closest_second = 0;
  double closest_ratio = kNan, closest_ratio_high = kNan;
};

PassDifferences compare_passes(std::span<const PassOnGrid> passes, double spacing_mm, const AlignPassesConfig& config);

}  // namespace asperity
