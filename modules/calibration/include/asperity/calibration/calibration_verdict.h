#pragma once

#include <string>

namespace asperity {

// Whether a calibration can be used, in words for the person who made it. Data that cannot determine the
// values at all are refused with an Error that says what to record instead.
struct CalibrationVerdict {
  bool trustworthy = true;
  std::string text;  // one or two sentences
};

}  // namespace asperity
