#pragma once

#include <span>
#include <string>
#include <vector>

#include "asperity/base/nan.h"
#include "asperity/profile/align_passes.h"
#include "asperity/profile/profile.h"
#include "asperity/profile/profile_pass.h"
#include "asperity/profile/texture_noise.h"

namespace asperity {

// One pass in a merge.
struct MergedPass {
  std::string name;
  std::vector<double> texture_m;  // its heights at the merge's points; nan in its gaps; empty: not used

  bool used = false;          // it agrees with the others, and could be laid on them
  bool laid = true;           // false: it agrees, but the alignment below a sample ran away, so it is not used
  PassAlignment alignment;    // on the first reference; of the reference itself none
  double shift_m = 0.0;       // place in the pass, from its first point in its direction, of the merge's first point
  double stretch = 0.0;       // length of the pass over the merge's, less 1
  double warp_rms_m = 0.0;    // of what is left of its places after shift and stretch
  double coherence = kNan;    // with the mean of the others, in the band
  double noise_rms_m = kNan;  // in the band, by its difference from the others; two passes: the same of both
  double stated_noise_rms_m = kNan;  // in the band, as the pass states it
  double weight = 0.0;               // of its heights, mean over path and band; all sum to 1
  std::vector<double> on_merge;      // where each of its points is on the merge, in points; nan: beside it
};

// Two passes, by their indices, and the power of their difference over that of the noise that they state together; its
// upper 95 % limit. nan: not determined.
struct PassPair {
  std::size_t first = 0, second = 0;
  double ratio = kNan, ratio_high = kNan;
};

// Passes over one line as one profile.
struct MergedProfile {
  bool agrees = false;  // at least two passes do; else nothing is merged
  std::size_t used = 0;
  Profile profile;     // from the merge's first point on; no noise removed
  TextureNoise noise;  // of profile.texture_m
  std::vector<MergedPass> passes;
  // The power of the passes' differences from their mean over the power of the noise that they state, and its 95 %
  // interval; nan: not determined.
  double noise_ratio = kNan, noise_ratio_low = kNan, noise_ratio_high = kNan;
  PassPair closest;  // the two that differ least for what they state
  // The differences as noise with the stated density times a factor, and lines that are apart by a distance.
  double noise_scale = kNan, apart_m = kNan;
  // A merge of K passes has the error N/K + U (1 − 1/K) from the line of each, N the power of their noise and U that by
  // which their lines differ; a pass has N. U over N: the merge is the better one where it is below 1.
  double lines_over_noise = kNan;
  std::vector<double> scatter_frequency_cycles_per_mm, scatter_psd_m2_mm;  // of a pass, by those differences
};

// Aligns passes over one line below a sample, with their stretch, and averages them by their noise (docs/merge.md).
//
// The reference is the pass with which the most others agree (align_passes.h); `false_alarm` is the chance that any two
// of them do though none are of one line, so each pair has its part of it. The others are laid on it, then each on the
// mean of the others, as warp_pass.h does; a pass whose places run away is left out. The merge's path is the mean of
// the passes' paths. In each of a row of bands the mean is weighted by the inverse of each pass' noise there, which is
// the stated one, or, where a pass differs from the others by more, that; and by its noise at the place. Gaps have no
// weight.
//
// Throws Error for fewer than two passes or as align_passes() does.
MergedProfile merge_passes(std::span<const ProfilePass> passes, const AlignPassesConfig& config);

}  // namespace asperity
