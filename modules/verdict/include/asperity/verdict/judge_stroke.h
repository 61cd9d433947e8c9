#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string_view>

#include "asperity/verdict/verdict.h"

namespace asperity {

// What a stroke's acceleration is compared with.
enum class StrokeQuiet : std::uint8_t { kNone, kRest, kAir, kQuietest, kStated, kAirMotion };
inline constexpr std::array<std::string_view, 6> kStrokeQuietNames{"none",     "rest",   "air",
                                                                   "quietest", "stated", "air_motion"};

// Of recordings of nothing but noise, the share that may count as vibration.
inline constexpr double kStrokeFalseAlarm = 1e-3;

// A haptic recording without orientations: numbers that show whether it is of a surface, no judgement.
struct StrokeEvidence {
  bool has_speed = false;  // by positions, not stated
  bool has_force = false;  // by a sensor that changes
  double largest_speed_mps = 0.0;
  double largest_force_N = 0.0;
  double contact_N = 0.0;  // from here on the tip counts as touching
  double contact_s = 0.0;  // with at least that force for a quarter of a second on end
  double free_s = 0.0;     // with less than half of it: the sensor's zero is in the data
  double moving_s = 0.0;   // faster than 10 mm/s, in contact where the force is known
  StrokeQuiet quiet = StrokeQuiet::kNone;
  double active_s = 0.0, quiet_s = 0.0;
  double active_mps2 = 0.0, quiet_mps2 = 0.0;  // RMS above 40 Hz
  double power_ratio = std::numeric_limits<double>::quiet_NaN();
  double power_ratio_sigma = std::numeric_limits<double>::quiet_NaN();
  double power_ratio_chance = std::numeric_limits<double>::quiet_NaN();  // of noise alone, to have it or more
  // The power of windows of 50 ms against their speed, as the exponent of a power law; nan: the speed hardly changes.
  double speed_exponent = std::numeric_limits<double>::quiet_NaN();
  double speed_exponent_sigma = std::numeric_limits<double>::quiet_NaN();
  double speed_exponent_margin = std::numeric_limits<double>::quiet_NaN();  // exceeded with kStrokeFalseAlarm
};

// The verdicts on a stroke, the worst first: whether anything was touched, whether it moved, whether the acceleration
// is of the motion, and what is not known without force or positions. Of the motion it is if noise alone has such a
// ratio of the powers with a chance of at most kStrokeFalseAlarm, and the ratio is above 1.2; without a force, where
// nothing shows that the tip touched, above 2 (a hand's free motion has up to 1.3, BROAD's waves); against the quietest
// part of the same recording above 4. Where nothing is quiet, if the exponent of the speed exceeds 0.3 by the margin.
Verdicts judge_stroke(const StrokeEvidence& evidence);

}  // namespace asperity
