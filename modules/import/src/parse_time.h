#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace asperity {

// The time that a decimal number of units spells, to the nearest nanosecond and without the rounding of a double: a
// unit has unit_ns nanoseconds. A point or a comma is the decimal mark. nullopt if it is no number or beyond ±2^62 ns.
std::optional<std::int64_t> parse_decimal_ns(std::string_view text, std::int64_t unit_ns);

// An ISO 8601 date with time ("2026-05-01T12:30:00.25Z", a blank for the T, "+02:00"; UTC where no zone is stated),
// since 1970, or a time of day alone ("12:30:00.25"), since midnight. Leap seconds do not count.
std::optional<std::int64_t> parse_date_time_ns(std::string_view text);

}  // namespace asperity
