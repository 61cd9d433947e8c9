#pragma once

#include <span>
#include <string>
#include <string_view>

#include "asperity/verdict/verdict.h"

namespace asperity {

// What one code stands for; docs/verdicts.md has the same table, and a test compares them.
struct VerdictCode {
  std::string_view code;
  Severity severity = Severity::kNote;
  std::string_view remedy;
};

// All codes of the program.
std::span<const VerdictCode> verdict_codes();

// A verdict of a code in the list, with the list's severity and remedy. Throws Error if the code is not in the list.
Verdict make_verdict(std::string_view code, std::string message);

}  // namespace asperity
