#pragma once

#include <string>

namespace asperity {

// A value and its standard error, or half its interval, for people: the texts before and after "±".
struct IntervalText {
  std::string value;
  std::string error;  // empty: not known
};

// The error is rounded to `digits` significant digits, from 1 to 15, and the value to the error's last one, at most to
// 15 significant digits: 110 and 30. Fixed notation where the larger of both is from 10^-6 to below 10^15, scientific
// beyond. An error that is not finite, or negative, is not known: then the value has `lone_digits` significant digits.
// Of an error of 0 the value has these too. A value that is not finite is "not determined", without an error.
IntervalText interval_parts(double value, double error, int digits = 2, int lone_digits = 5);

// The same in one text: "110 ± 30", "110" or "not determined".
std::string interval_text(double value, double error, int digits = 2, int lone_digits = 5);

}  // namespace asperity
