#include "asperity/verdict/judge_passes.h"

#include <cmath>

#include <fmt/format.h>

#include "asperity/verdict/verdict_codes.h"

namespace asperity {

PassWitness witness_of_passes(const PassEvidence& evidence) {
  if (!std::isfinite(evidence.low) || !std::isfinite(evidence.high)) return PassWitness::kNone;
  if (evidence.low > 1.0) return PassWitness::kTooSmall;
  return evidence.high < 1.0 ? PassWitness::kLargerThanDifferences : PassWitness::kConfirms;
}

std::string_view witness_word(PassWitness witness) {
  switch (witness) {
    case PassWitness::kConfirms:
      return "confirmed";
    case PassWitness::kTooSmall:
      return "too small";
    case PassWitness::kLargerThanDifferences:
      return "larger than the differences";
    case PassWitness::kNone:
      break;
  }
  return "not determined";
}

void judge_passes(const PassEvidence& evidence, Verdicts& out) {
  if (witness_of_passes(evidence) != PassWitness::kTooSmall) return;
  out.push_back(make_verdict("passes_disagree",
                             fmt::format("passes over one line differ by {:.2g} times the power of the noise that they "
                                         "state, 95 %: {:.2g} to {:.2g}",
                                         evidence.ratio, evidence.low, evidence.high)));
}

}  // namespace asperity
