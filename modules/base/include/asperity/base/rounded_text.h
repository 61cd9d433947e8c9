#pragma once

#include <string>

namespace asperity {

// `value` for people: at most `digits` significant digits, from 1 to 15, without trailing zeros; in fixed notation from
// 0.0001 to below 10^15 (110, not 1.1e+02). Files keep the shortest text that reads back as the same number:
// append_number. A value with its standard error: interval_text.h.
std::string rounded_text(double value, int digits = 3);

}  // namespace asperity
