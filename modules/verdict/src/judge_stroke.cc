#include "asperity/verdict/judge_stroke.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "asperity/verdict/verdict_codes.h"

namespace asperity {

namespace {

constexpr double kShortest_s = 0.25;
constexpr double kShortestFree_s = 0.05;  // that the zero of the force is seen
constexpr double kLeastRatio = 1.2, kLeastRatioOfQuietest = 4.0, kWeakRatio = 2.0;
constexpr double kLeastExponent = 0.3;

const char* quiet_name(StrokeQuiet quiet) {
  switch (quiet) {
    case StrokeQuiet::kRest:
      return "while stationary";
    case StrokeQuiet::kAir:
      return "without contact";
    case StrokeQuiet::kAirMotion:
      return "in motion without contact";
    case StrokeQuiet::kQuietest:
      return "of its quietest part";
    case StrokeQuiet::kStated:
      return "of the stated noise";
    case StrokeQuiet::kNone:
      break;
  }
  return "";
}

// Whether the acceleration is of the stroke, by its power in motion beside that in quiet.
void judge_power(const StrokeEvidence& e, Verdicts& out) {
  const std::string found = fmt::format(
      "above 40 Hz its power is {:.3g} ± {:.2g} times that {}, which noise alone has with a chance of {:.1g}",
      e.power_ratio, e.power_ratio_sigma, quiet_name(e.quiet), e.power_ratio_chance);
  const bool by_chance = !(e.power_ratio_chance <= kStrokeFalseAlarm);
  if (e.quiet == StrokeQuiet::kQuietest) {
    if (by_chance || e.power_ratio < kLeastRatioOfQuietest) {
      out.push_back(make_verdict("contact_undetermined",
                                 "without positions and force, vibration and noise cannot be distinguished: " + found));
    }
  } else if (by_chance || e.power_ratio < kLeastRatio) {
    out.push_back(make_verdict("vibration_is_noise", "the acceleration is not of the stroke: " + found));
  } else if (e.power_ratio < kWeakRatio && !e.has_force) {
    out.push_back(make_verdict("contact_undetermined",
                               "without a force, so weak a vibration may be the hand's own motion: " + found));
  } else if (e.power_ratio < kWeakRatio) {
    out.push_back(make_verdict("vibration_weak", "more than half of the acceleration is noise: " + found));
  }
}

// The same where nothing is quiet: vibration grows with the speed, noise does not.
void judge_growth(const StrokeEvidence& e, Verdicts& out) {
  const double slack = e.speed_exponent_margin;
  if (!std::isfinite(e.speed_exponent)) {
    out.push_back(make_verdict("contact_undetermined",
                               "no part of the recording is quiet: vibration and noise cannot be distinguished"));
    return;
  }
  const std::string found = fmt::format("no part is quiet, and the power grows with the speed to the {:.2g} ± {:.2g}",
                                        e.speed_exponent, e.speed_exponent_sigma);
  if (e.speed_exponent + slack < kLeastExponent) {
    out.push_back(make_verdict("vibration_is_noise", "the acceleration is not of the stroke: " + found));
  } else if (!(e.speed_exponent - slack >= kLeastExponent)) {
    out.push_back(make_verdict("contact_undetermined", "vibration and noise cannot be distinguished: " + found));
  }
}

}  // namespace

Verdicts judge_stroke(const StrokeEvidence& e) {
  Verdicts out;
  const bool touches = !e.has_force || e.contact_s >= kShortest_s;
  const bool moves = !e.has_speed || e.moving_s >= kShortest_s;
  if (!touches) {
    out.push_back(make_verdict(
        "nothing_touched",
        fmt::format("the force is never {:g} N or more for {:g} s without interruption; the largest is {:.3g} N",
                    e.contact_N, kShortest_s, e.largest_force_N)));
  } else if (!moves) {
    out.push_back(make_verdict(
        "not_moved", fmt::format("the tip is faster than 10 mm/s {}for {:.2g} s only; the largest speed is {:.3g} mm/s",
                                 e.has_force ? "in contact " : "", e.moving_s, 1e3 * e.largest_speed_mps)));
  } else if (std::isfinite(e.power_ratio)) {
    judge_power(e, out);
  } else {
    judge_growth(e, out);
  }
  if (!e.has_force)
    out.push_back(make_verdict("contact_unknown", "force was not measured, so that contact is not shown"));
  // A sensor that was not zeroed, or the weight of the tool, has a force in the air, too.
  if (e.has_force && e.contact_s > 0.0 && e.free_s < kShortestFree_s) {
    out.push_back(
        make_verdict("force_zero_unseen", fmt::format("the force is below {:g} N for {:.2g} s only: contact cannot be "
                                                      "distinguished from a sensor that was not zeroed",
                                                      0.5 * e.contact_N, e.free_s)));
  }
  if (!e.has_speed) {
    out.push_back(make_verdict("lengths_undetermined",
                               "no positions were measured, so that lengths are known by the stated speed only"));
  }
  sort_verdicts(out);
  return out;
}

}  // namespace asperity
