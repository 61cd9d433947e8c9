#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>

namespace asperity {

// Quantities as people type them: a number and its unit. Each throws Error naming `what` and the text.
double parse_length_m(std::string_view text, std::string_view what);    // 5mm 0.3m 2.5cm 0.5um 0.5µm 120nm
double parse_speed_mps(std::string_view text, std::string_view what);   // 25mm/s 0.02m/s
double parse_duration_s(std::string_view text, std::string_view what);  // 10s 250ms 2min

// A unit of length: its name (m, mm, …) or how long it is (0.06m). From 1 nm to 1000 m, else it throws in the same way.
double parse_length_unit_m(std::string_view text, std::string_view what);

// A column's name that ends in its unit of length (_nm, _um, _µm, _mm, _cm, _m), as "height_um".
struct NamedLength {
  std::string_view quantity;  // the name before it
  double unit_m = 1.0;
};
std::optional<NamedLength> split_length_name(std::string_view column);  // nullopt if it has none

inline constexpr double kStandardGravity_mps2 = 9.80665;
inline constexpr double kNanosecond_s = 1e-9;

// To the nearest nanosecond.
inline std::int64_t nanoseconds(double time_s) { return std::llround(time_s / kNanosecond_s); }

}  // namespace asperity
