#pragma once

#include <string>

#include "asperity/base/nan.h"
#include "asperity/verdict/verdict.h"

namespace asperity {

// A held-back stroke beside the rendered surface: numbers, no judgement.
struct RealismEvidence {
  double score = kNan;    // nan: nothing could be compared
  double ceiling = kNan;  // of another real stroke; nan: there is none
  double min_score = 0.3;
  bool is_placed = false;       // the stroke's heights were found on the rendered surface
  std::string no_places;        // why the rendered surface has no places; empty: it has
  bool stiffness_known = true;  // the spring that is rendered comes from the scene
  bool has_others = false;
  bool others_agree = false;  // with the held-back stroke, over one line
  bool is_own = false;        // the rendered surface was made from this stroke
};

// The verdicts on a score of real against rendered, the worst first.
Verdicts judge_realism(const RealismEvidence& evidence);

}  // namespace asperity
