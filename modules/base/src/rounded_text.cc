#include "asperity/base/rounded_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace asperity {

std::string rounded_text(double value, int digits) {
  constexpr double kMostFixed = 1e15;
  std::string out = fmt::format("{:.{}g}", value, std::clamp(digits, 1, 15));
  const bool scientific = out.find("e+") != std::string::npos;
  if (!scientific) return out;
  const double rounded = std::strtod(out.c_str(), nullptr);
  return std::abs(rounded) < kMostFixed ? fmt::format("{:.0f}", rounded) : out;
}

}  // namespace asperity
