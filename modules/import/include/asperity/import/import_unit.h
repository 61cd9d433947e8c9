#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace asperity {

enum class Quantity { kTime, kLength, kAngle, kRate, kAcceleration, kForce, kNumber };

// A unit in the words of its field.
struct ImportUnit {
  std::string name;        // as it is written to a mapping
  double factor = 1.0;     // a value times this is in s, m, rad, rad/s, m/s², N
  std::int64_t ns = 0;     // of a unit of time: its nanoseconds
  bool is_date = false;    // of a time: ISO 8601 text
  bool is_counts = false;  // with a scale that the person gave
};

// The unit that `text` names: "mm", "deg/s", "rad s^-1", "m/s²", "mN", …, letters of either case where that leaves no
// doubt. A number or a fraction before it scales it: "1/16384 g", "0.061 mg" for counts; "counts" alone is of Quantity
// kNumber. nullopt if it is not a unit of this quantity.
std::optional<ImportUnit> find_import_unit(std::string_view text, Quantity quantity);

// The same; throws Error naming `what`, the text and the known units.
ImportUnit parse_import_unit(std::string_view text, Quantity quantity, std::string_view what);

// The known units of a quantity, with commas between.
std::string import_unit_names(Quantity quantity);

// True if the text is a unit of any quantity.
bool is_unit(std::string_view text);

}  // namespace asperity
