#pragma once

#include <vector>

#include "asperity/base/config.h"
#include "asperity/profile/profile_pass.h"

namespace asperity {

struct AlignPassesConfig {
  double low_cycles_per_mm = 0.15;
  double high_cycles_per_mm = 4.0;
  double max_stretch = 0.01;
  double min_overlap = 0.5;
  double false_alarm = 1e-3;
  double knot_spacing_m = 5e-3;
  double place_sigma_m = 0.05e-3;

  template <class V>
  void visit(V& v) {
    v.field("low_cycles_per_mm", low_cycles_per_mm, "waves from here on align the passes", {1e-4, 20.0});
    v.field("high_cycles_per_mm", high_cycles_per_mm, "waves up to here align the passes", {1e-3, 20.0});
    v.field("max_stretch", max_stretch, "largest relative difference of the passes' lengths that is searched",
            {0.0, 0.1});
    v.field("min_overlap", min_overlap, "part of the shorter pass that must be on the other", {0.1, 1.0});
    v.field("false_alarm", false_alarm, "chance that passes over different lines count as agreeing", {1e-12, 0.5});
    v.field("knot_spacing_m", knot_spacing_m, "of the knots of the passes' stretch", {1e-4, 1.0});
    v.field("place_sigma_m", place_sigma_m, "standard deviation of a position along the path where a pass states none",
            {1e-6, 0.1});
  }
};

// Where one pass lies on another.
struct PassAlignment {
  bool agrees = false;    // the two are of one line, by the test below
  bool reversed = false;  // travelled the other way
  double shift_m = 0.0;   // place in the pass of the reference's first point, after the reversal
  double stretch = 0.0;   // length along the pass over length along the reference, less 1
  double score = 0.0;     // of the test, in standard deviations of what chance gives
  double threshold = 0.0;
};

// Where `pass` lies on `reference`, a shift and a stretch, in either direction (docs/merge.md). Both have one spacing.
//
// Where both state their `place`, the search is no further from it than its reach, in its direction alone.
//
// The search is a generalised cross-correlation (Knapp and Carter, IEEE Trans. ASSP 24, 1976): both spectra are divided
// by the roots of their own densities, and weighted by the coherence that the stated noises allow and by the blur of
// their places. It is done for each of a row of stretches that differ by a quarter of the shortest wave at the ends.
//
// The test asks whether what was found could be chance. At the best place the segments of 12.8 mm have the whitened
// cross-spectra a e^{jφ}; for passes of different lines the φ are even and independent, and Σ a cos φ has the variance
// Σ a²/2, whatever the textures' spectra are. Its ratio to the root of this, `score`, is to exceed the normal quantile
// of `false_alarm` over the number of independent shifts, stretches and directions that were searched.
// Throws Error if the spacings differ or a pass has no heights.
PassAlignment align_passes(const ProfilePass& reference, const ProfilePass& pass, const AlignPassesConfig& config);

}  // namespace asperity
