#pragma once

#include <string>

namespace asperity {

// `value` for people: at most `digits` significant digits, from 1 to 15, without zeros that tell nothing. Files keep
// the shortest text that reads back as the same number: append_number.
std::string rounded_text(double value, int digits = 3);

}  // namespace asperity
