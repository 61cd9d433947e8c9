#pragma once

#include "asperity/base/config.h"
#include "asperity/base/progress.h"
#include "asperity/pipeline/press_in_scan.h"
#include "asperity/pipeline/process_result.h"
#include "asperity/pipeline/rendering_score.h"
#include "asperity/profile/compare_profiles.h"
#include "asperity/render/render_model.h"

namespace asperity {

struct ScoreConfig {
  double segment_mm = 20.0;
  double least_part = 0.03;
  double half_dB = 6.0;
  double poor = 0.5;
  double least_touched = 0.9;
  ComparisonConfig comparison;

  template <class V>
  void visit(V& v) {
    v.field("segment_mm", segment_mm, "of the spectra's averaging, mm", {1e-3, 1e6});
    v.field("least_part", least_part, "of the whole RMS: an octave below it in both is not felt", {0.0, 1.0});
    v.field("half_dB", half_dB, "distance of spectra that halves their agreement, dB", {0.1, 100.0});
    v.field("poor", poor, "a score below it is not to be trusted", {0.0, 1.0});
    v.field("least_touched", least_touched, "part of the scan's contact that must be felt", {0.0, 1.0});
    v.group("comparison", comparison);
  }
};

// Compares a recorded scan with what the renderer makes of its path: `pressed` (press_in_scan.h) is run through
// render_step at `servo_Hz`, without a device and its safety layer, and in contact
//
//   the rendered height, that of the texture under the proxy, is held against the profile's height_m,
//   the rendered normal force f·n against the measured one,
//
// over the scan's arc length in the band of the contract: from low to min(high, 0.4 rate/speed) cycles/mm, second-order
// Butterworth, zero phase, both sides alike. Heights: correlation after the one rigid shift that serves it best
// (compare_profiles.h). Both: octave spectra by Welch (compare_textures.h) with their distance D, the RMS over the felt
// octaves of 20 log10(rendered/real). An agreement is A(D) = 2^(−D/half_dB). With the correlation c ≥ 0,
//
//   heights  √(c · A(D_height)), or A(D_height) alone for a texture that repeats over the path
//   force    A(D_force)
//   score    √(heights · force)
//
// The device point moves as if the hand were rigid, which a real one is not: the force's part stays below 1 for a
// faithful texture too (docs/feel.md). Throws Error for a scan that is never in contact or too short for a spectrum.
RenderingScore score_rendering(const ProcessResult& measured, const PressedScan& pressed, const RenderModel& model,
                               double servo_Hz, const ScoreConfig& config, const Observer& observer = {});

}  // namespace asperity
