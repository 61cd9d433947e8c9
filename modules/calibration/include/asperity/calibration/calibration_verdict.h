#pragma once

#include <string>
#include <string_view>

#include "asperity/verdict/verdict.h"

namespace asperity {

// Whether a calibration can be used, in words for the person who made it. Data that cannot determine the
// values at all are refused with an Error that states what to record instead.
struct CalibrationVerdict {
  bool trustworthy = true;  // none of `verdicts` is invalid
  std::string text;         // one or two sentences: what was found, then the verdicts but for notes
  Verdicts verdicts;

  // Adds a verdict of a code in verdict_codes.h; `message` begins with a small letter and has no full stop. Throws
  // Error for a code that is not there.
  void add(std::string_view code, const std::string& message);
};

}  // namespace asperity
