#include "asperity/base/plausible_profile.h"

#include <cmath>
#include <optional>
#include <string>

#include "asperity/base/error.h"
#include "asperity/base/text.h"

namespace asperity {

void require_plausible_spacing(double spacing_m, std::string_view what) {
  if (spacing_m >= kSmallestSpacing_m && spacing_m <= kLargestSpacing_m) return;
  const std::string text = std::string(what) + ": the spacing " + number_text(spacing_m) + " m is not ";
  if (!(spacing_m > 0.0) || !std::isfinite(spacing_m)) throw Error(text + "a positive length");
  throw Error(text + "plausible: " + number_text(kSmallestSpacing_m) + " to " + number_text(kLargestSpacing_m) + " m");
}

void require_plausible_heights(std::span<const double> height_m, std::string_view what) {
  for (std::size_t i = 0; i < height_m.size(); ++i) {
    if (std::isnan(height_m[i]) || std::abs(height_m[i]) <= kPlausibleHeight_m) continue;
    const std::string text = std::string(what) + ": height " + std::to_string(i + 1) + " is ";
    if (std::isinf(height_m[i])) throw Error(text + "infinite");
    throw Error(text + number_text(height_m[i]) + " m, which is not plausible: at most " +
                number_text(kPlausibleHeight_m) + " m");
  }
}

void require_unequal(std::string_view name, std::span<const double> values, std::string_view what) {
  std::optional<double> first;
  for (const double value : values) {
    if (std::isnan(value)) continue;
    if (first && value != *first) return;
    if (!first) first = value;
  }
  if (first)
    throw Error(std::string(what) + ": all " + std::string(name) + " are equal, so that a texture cannot be fitted");
}

}  // namespace asperity
