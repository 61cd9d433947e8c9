#pragma once

#include <string_view>

#include "asperity/verdict/verdict.h"

namespace asperity {

// The power of the differences of passes over one line, over the power of the noise that they state, and its 95 %
// interval (docs/merge.md). nan: not determined.
struct PassEvidence {
  double ratio = 0.0;
  double low = 0.0;
  double high = 0.0;
};

// How the stated error of the heights stands beside what the passes show of it.
enum class PassWitness { kNone, kConfirms, kContradictsAsTooSmall, kContradictsAsTooLarge };
PassWitness witness_of_passes(const PassEvidence& evidence);
// "not determined", "confirmed", "too small", "too large".
std::string_view witness_word(PassWitness witness);

// Adds `passes_disagree` where the interval is wholly above 1, `noise_overstated` where it is wholly below.
void judge_passes(const PassEvidence& evidence, Verdicts& out);

}  // namespace asperity
