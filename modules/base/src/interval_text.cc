#include "asperity/base/interval_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "asperity/base/rounded_text.h"

namespace asperity {

namespace {

constexpr int kMostDigits = 15;
constexpr int kLeastFixedExponent = -6;  // of an interval: 0.0000012 ± 0.0000003 is still read at a glance

// The decimal exponent of the first digit of `value` after it is rounded to `digits` digits; that of 0 is 0.
int exponent_of(double value, int digits) {
  const std::string text = fmt::format("{:.{}e}", value, digits - 1);
  return std::atoi(text.c_str() + text.find('e') + 1);
}

// `value` rounded to the decimal place `last` (-2: hundredths, 1: tens), without a negative zero.
std::string rounded_at(double value, int last) {
  std::string out;
  if (last <= 0) {
    out = fmt::format("{:.{}f}", value, -last);
  } else {
    const double step = std::pow(10.0, last);
    out = fmt::format("{:.0f}", std::round(value / step) * step);
  }
  if (out.starts_with('-') && out.find_first_not_of("-0.") == std::string::npos) out.erase(0, 1);
  return out;
}

}  // namespace

IntervalText interval_parts(double value, double error, int digits, int lone_digits) {
  if (!std::isfinite(value)) return {"not determined", {}};
  if (!std::isfinite(error) || error < 0.0) return {rounded_text(value, lone_digits), {}};
  if (error == 0.0) return {rounded_text(value, lone_digits), "0"};
  const int kept = std::clamp(digits, 1, kMostDigits);
  const int first = std::max(exponent_of(error, kept), value == 0.0 ? -400 : exponent_of(value, kept));
  const int last = std::max(exponent_of(error, kept) - kept + 1, first - kMostDigits + 1);
  if (first >= kLeastFixedExponent && first < kMostDigits) return {rounded_at(value, last), rounded_at(error, last)};
  // Both with as many digits as reach to the same last one.
  const auto scientific = [last](double number) {
    if (number == 0.0) return std::string("0");
    return fmt::format("{:.{}e}", number, std::max(0, exponent_of(number, kMostDigits) - last));
  };
  return {scientific(value), scientific(error)};
}

std::string interval_text(double value, double error, int digits, int lone_digits) {
  const IntervalText parts = interval_parts(value, error, digits, lone_digits);
  return parts.error.empty() ? parts.value : parts.value + " ± " + parts.error;
}

}  // namespace asperity
