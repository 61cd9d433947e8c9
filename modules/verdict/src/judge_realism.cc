#include "asperity/verdict/judge_realism.h"

#include <fmt/format.h>

#include <cmath>

#include "asperity/verdict/verdict_codes.h"

namespace asperity {

namespace {

constexpr double kFarBelow = 0.5;  // of the ceiling

}  // namespace

Verdicts judge_realism(const RealismEvidence& evidence) {
  Verdicts out;
  const auto say = [&](const char* code, std::string message) {
    out.push_back(make_verdict(code, std::move(message)));
  };
  if (evidence.has_others && !evidence.others_agree) {
    say("no_common_line", "the other strokes did not pass over the same line as the held-back one");
  } else if (!std::isfinite(evidence.score)) {
    say("realism_undetermined", "the real strokes do not agree in any band: nothing can be compared");
  }
  if (evidence.no_places.empty() && !evidence.is_placed)
    say("stroke_not_on_texture", "the stroke's heights were not found on the rendered surface");
  if (evidence.score < evidence.min_score) {
    say("unlike_real", fmt::format("real against rendered: a score of {:.2f} is what noise can have", evidence.score));
  } else if (evidence.score < kFarBelow * evidence.ceiling) {
    say("far_from_real", fmt::format("real against rendered: a score of {:.2f} where two real strokes have {:.2f}",
                                     evidence.score, evidence.ceiling));
  }
  if (!evidence.no_places.empty())
    say("texture_without_places", evidence.no_places + ": its heights cannot follow the stroke's");
  if (evidence.is_own)
    say("own_stroke", "the rendered surface was made from this stroke: the score is not a test of it");
  if (!evidence.stiffness_known)
    say("stiffness_assumed", "the scene has no stiffness: the renderer's usual one is compared");
  if (!evidence.has_others) {
    say("ceiling_undetermined", "no other real stroke was given: the ceiling is not determined");
  } else if (evidence.others_agree && !std::isfinite(evidence.ceiling)) {
    say("ceiling_undetermined", "the other real strokes could not be compared: the ceiling is not determined");
  }
  sort_verdicts(out);
  return out;
}

}  // namespace asperity
