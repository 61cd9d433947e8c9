#pragma once

#include <string>
#include <vector>

#include "asperity/base/nan.h"
#include "asperity/fidelity/render_stroke.h"
#include "asperity/fidelity/signal_agreement.h"
#include "asperity/fidelity/virtual_probe.h"
#include "asperity/profile/align_passes.h"
#include "asperity/verdict/verdict.h"

namespace asperity {

// One measured quantity of the held-back stroke beside the rendered one, and beside other real strokes.
struct RealismChannel {
  SignalAgreement rendered;
  double score = kNan;  // agreement_score() of it
  // Means over the other strokes; nan: there is none.
  double ceiling_score = kNan, ceiling_correlation = kNan, ceiling_distance_dB = kNan, ceiling_level_dB = kNan;
};

// The tangential force over the normal one, sums over the stroke; a sensor with three axes measures it.
struct FrictionShare {
  double real = kNan, rendered = kNan, other = kNan;  // nan: not measured
  double score = kNan, ceiling_score = kNan;
};

struct OtherStroke {
  std::string name;
  PassAlignment alignment;  // on the held-back stroke
  double speed_mps = kNan;  // median
  double score = kNan;      // of this stroke in place of the rendered one
};

// A held-back stroke beside the rendered surface (score_realism.h). nan: not determined.
struct RealismScore {
  double score = kNan, low = kNan, high = kNan;                    // 0 to 1, and 95 %
  double ceiling = kNan, ceiling_low = kNan, ceiling_high = kNan;  // the same of another real stroke
  RealismChannel acceleration;                                     // m/s², at the stroke's usual speed
  RealismChannel force;                                            // N, as the sensor reads it
  FrictionShare friction;

  PassAlignment alignment;   // of the rendered surface on the stroke
  double compared_m = 0.0;   // length of path
  std::size_t segments = 0;  // of the spectra
  double speed_mps = kNan;   // median
  HandImpedance hand;
  RenderedContact contact;
  bool stiffness_known = false, friction_known = false;
  std::string no_places;  // why the rendered surface has no positions, in words; empty: it has
  std::vector<OtherStroke> others;
  Verdicts verdicts;        // judge_realism.h
  bool trustworthy = true;  // none is invalid
};

}  // namespace asperity
