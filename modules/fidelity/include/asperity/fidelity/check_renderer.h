#pragma once

#include "asperity/base/config.h"
#include "asperity/base/progress.h"
#include "asperity/fidelity/press_in_scan.h"
#include "asperity/fidelity/renderer_check.h"
#include "asperity/pipeline/process_result.h"
#include "asperity/profile/compare_profiles.h"
#include "asperity/render/render_model.h"

namespace asperity {

struct RendererCheckConfig {
  double segment_mm = 20.0;
  double least_part = 0.03;
  double half_dB = 6.0;
  double half_distribution = 0.3;
  double min_score = 0.5;
  double min_contact_fraction = 0.9;
  ComparisonConfig comparison;

  // Real and rendered share their arc length, so nothing but the coordinates' error is left to a shift.
  RendererCheckConfig() { comparison.max_shift_m = 0.25e-3; }

  template <class V>
  void visit(V& v) {
    v.field("segment_mm", segment_mm, "of the spectra's averaging, mm", {1e-3, 1e6});
    v.field("least_part", least_part, "of the whole RMS: an octave below it in both is below the threshold",
            {0.0, 1.0});
    v.field("half_dB", half_dB, "distance of spectra that halves their agreement, dB", {0.1, 100.0});
    v.field("half_distribution", half_distribution,
            "distance of the heights' distributions that halves their agreement, in RMS heights", {1e-3, 100.0});
    v.field("min_score", min_score, "a score below it is invalid", {0.0, 1.0});
    v.former("poor");
    v.field("min_contact_fraction", min_contact_fraction, "part of the scan's contact that must be rendered",
            {0.0, 1.0});
    v.former("least_touched");
    v.group("comparison", comparison);
  }
};

// Compares a recorded scan with what the renderer makes of its path: `pressed` (press_in_scan.h) is run through
// render_step at `servo_Hz`, without a device and its safety layer, and in contact
//
//   the rendered height, that of the texture under the proxy, is held against the profile's height_m,
//   the rendered normal force beyond the measured one, f·n − F, against k_c k_s H (thesis §6.5 (5)) of the real
//   heights H, their lowest at 0 as a texture's are (erratum 20): the contact force (4) of the press is F by itself,
//
// over the scan's arc length in the band of the contract: from low to min(high, 0.4 rate/speed) cycles/mm, second-order
// Butterworth, zero phase, both sides alike. Octave spectra are Welch's (compare_textures.h); their distance D is the
// RMS over the felt octaves of 20 log10(rendered/real), and A(D) = 2^(−D/half_dB). ρ is rendered over real RMS height,
// c the heights' correlation after one rigid shift (compare_profiles.h), W the mean difference of their quantiles over
// the real RMS height (the distributions' Wasserstein distance).
//
//   heights  max(c, 0) · min(ρ, 1/ρ) · A(D_height); for a texture that cannot have the scan's phase (one that repeats
//            over the path, or with random phases) with 2^(−W/half_distribution) instead of c
//   force    A(D_force)
//   score    heights · force
//
// Rendered against measured force is told beside it and not judged: the device point moves as if the hand were rigid
// (docs/feel.md). Throws Error for a scan that is never in contact or too short for a spectrum.
RendererCheck check_renderer(const ProcessResult& measured, const PressedScan& pressed, const RenderModel& model,
                             double servo_Hz, const RendererCheckConfig& config, const Observer& observer = {});

}  // namespace asperity
