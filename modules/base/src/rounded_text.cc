#include "asperity/base/rounded_text.h"

#include <fmt/format.h>

#include <algorithm>

namespace asperity {

std::string rounded_text(double value, int digits) { return fmt::format("{:.{}g}", value, std::clamp(digits, 1, 15)); }

}  // namespace asperity
