#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "asperity/geometry/motion.h"
#include "asperity/profile/compare_profiles.h"
#include "asperity/profile/profile.h"
#include "asperity/recording/recording.h"

namespace asperity {

// How far a measurement is from the truth that the recording knows.
struct Accuracy {
  double position_rms_m = 0.0;  // of the tip, the three axes together
  double tracker_rms_m = 0.0;   // the same for the raw poses, linearly interpolated, latency as calibrated
  double position_error_over_sigma = std::numeric_limits<double>::quiet_NaN();  // RMS by axis; 1: honest error bars
  std::size_t compared = 0;  // true positions that both were compared at
  double band_high_cycles_per_mm = 0.0;
  std::optional<ProfileComparison> profile;  // nullopt: the truth has no heights
  ComparedHeights heights;                   // both profiles in that band, aligned
};

// Positions are compared at the truth's own times, within the spans of the motion and of the poses;
// profiles in the band from config.low_cycles_per_mm to the smaller of config.high_cycles_per_mm and
// 0.4·rate/speed (compare_profiles.h), with the probe's mean rate and the true mean speed of travel.
// With `texture_of`, the high-pass of heights with the profile's spacing, the profile's texture_m is compared with the
// texture that it makes of the true heights; without it height_m with the true heights.
// The length's error is that of Coverage::length_m against the true place in the last tenth of a second in contact less
// that in the first, by medians where the tip rests there; of the compared spans where the truth does not allow that.
// Throws Error if the recording has no truth or the spans do not overlap.
using TextureOf = std::function<std::vector<double>(const std::vector<double>& height_m)>;
Accuracy measure_accuracy(const Recording& recording, const TipMotion& motion, const Profile& profile,
                          const ComparisonConfig& config, const TextureOf& texture_of = {});

}  // namespace asperity
