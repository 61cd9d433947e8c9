#pragma once

#include "asperity/base/nan.h"
#include "asperity/profile/merge_passes.h"

namespace asperity {

// What a merge gains against one of its strokes: the noise of both in the band of `config`, RMS. nan: not known.
struct MergeGain {
  double stroke_noise_rms_m = kNan;  // root mean square over the strokes that are merged
  double merged_noise_rms_m = kNan;
  double share = kNan;  // the second over the first; 1/√K for K strokes of equal noise that have no error in common
};

// A stroke's noise is what it states or, where its differences from the others show more, that. The merge's is that of
// merged.noise: densities of added noise and of misplaced heights over the band, and the error of the scale, for which
// all of the texture's power counts. nan where nothing was merged or the noise is not known.
MergeGain merge_gain(const MergedProfile& merged, const AlignPassesConfig& config);

}  // namespace asperity
