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

// How the stated error of the heights stands beside what the passes show of it. They show what differs from pass to
// pass: an error that they have in common is in the stated one alone, so smaller differences contradict nothing.
enum class PassWitness { kNone, kConfirms, kTooSmall, kLargerThanDifferences };
PassWitness witness_of_passes(const PassEvidence& evidence);
// "not determined", "confirmed", "too small", "larger than the differences".
std::string_view witness_word(PassWitness witness);

// Adds `passes_disagree` where the interval is wholly above 1.
void judge_passes(const PassEvidence& evidence, Verdicts& out);

}  // namespace asperity
