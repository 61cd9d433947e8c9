#include "feel/feel_json.h"

#include <array>

namespace asperity::studio {

namespace {

constexpr std::array<const char*, 4> kEnds{"its time was over", "the way was at its end", "stopped", "fault"};
}  // namespace

Json outcome_json(const FeelOutcome& outcome, const ServoConfig& servo) {
  Json out;
  out["end"] = kEnds.at(static_cast<std::size_t>(outcome.servo.end));
  out["doubts"] = outcome.verdict.doubts;
  out["warnings"] = outcome.verdict.warnings;
  out["duration_s"] = static_cast<double>(outcome.figures.ticks()) / servo.rate_Hz;
  out["figures"] = outcome.figures.json();
  out["timing"] = timing_json(outcome.servo.statistics, servo);
  out["text"] = outcome.figures.text();
  return out;
}

}  // namespace asperity::studio
