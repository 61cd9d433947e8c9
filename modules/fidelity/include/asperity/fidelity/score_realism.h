#pragma once

#include <span>
#include <string>

#include "asperity/base/config.h"
#include "asperity/base/progress.h"
#include "asperity/fidelity/realism_score.h"
#include "asperity/fidelity/rendered_relief.h"
#include "asperity/fidelity/virtual_probe.h"
#include "asperity/pipeline/process_result.h"
#include "asperity/profile/align_passes.h"
#include "asperity/recording/calibration.h"

namespace asperity {

struct RealismConfig {
  AlignPassesConfig align;  // its band is that of the comparison
  VirtualProbeConfig probe;
  double segment_m = 12.8e-3;
  double half_dB = 6.0;
  double least_part = 0.03;
  double false_alarm = 0.01;
  double least_snr = 2.0;
  double margin_m = 2e-3;
  double max_place_error_m = 2e-3;
  double min_score = 0.3;

  template <class V>
  void visit(V& v) {
    v.group("align", align);
    v.group("probe", probe);
    v.field("segment_m", segment_m, "of the spectra's averaging", {1e-3, 1.0});
    v.field("half_dB", half_dB, "distance of spectra that halves their agreement, dB", {0.1, 100.0});
    v.field("least_part", least_part, "of the whole RMS: a weaker band is not compared", {0.0, 1.0});
    v.field("false_alarm", false_alarm, "chance that a band in which the real strokes do not agree counts as agreed",
            {1e-9, 0.5});
    v.field("least_snr", least_snr,
            "of the stroke's heights in a band that is compared, where no other stroke is given", {0.0, 1e6});
    v.field("margin_m", margin_m, "left out at both ends of the stroke", {0.0, 1.0});
    v.field("max_place_error_m", max_place_error_m, "of a scene's coordinates: no better place is looked for beyond it",
            {0.0, 1.0});
    v.field("min_score", min_score, "a score below it is invalid", {0.0, 1.0});
  }
};

// A processed stroke, its heights without the noise removed (`profile.remove_noise` off).
struct RealStroke {
  std::string name;
  ProcessResult result;
  Calibration calibration;
};

// Compares what was measured of a held-back stroke with what the same hand and probe would have measured over a
// rendered surface (docs/realism.md). The relief is laid on the stroke by its heights (align_passes.h, lay_pass.h), a
// virtual tip is led over it (render_stroke.h) with the hand that the stroke itself shows (estimate_hand.h), and over
// the path, in third octaves, are compared
//
//   acceleration   n·a (v₀/v)², v the speed, v₀ its median
//   force          as the sensor reads it
//
// c is the correlation and D the RMS over the bands of 20 log10(rendered/real):
//
//   q = max(c, 0) · 2^(−D/half_dB),      score = (q_acceleration q_force q_friction)^(1/2)
//
// q_friction = 2^(−|20 log10(τ_rendered/τ_real)|/half_dB), τ the sum of the tangential over that of the normal force,
// where the sensor has three axes; else 1. Bands: those in which `others`, real strokes over the same line, agree with
// the held-back one (coherence above what chance gives) and which hold
// least_part of the RMS; without others, those in which the stroke's heights have least_snr. `ceiling` is the score of
// the other strokes in place of the rendered surface, their mean. The 95 % intervals are by the jackknife over the
// segments.
//
// Throws Error if a stroke has no force, the strokes are too short (four segments), or the rendered surface does not
// cover that much of the stroke.
RealismScore score_realism(const RenderedRelief& relief, const RealStroke& stroke, std::span<const RealStroke> others,
                           const RealismConfig& config, const Observer& observer = {});

}  // namespace asperity
