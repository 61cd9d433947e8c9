#include "feel/feel_json.h"

#include <array>
#include <filesystem>

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
  out["timing"] = app::timing_json(outcome.servo.statistics, servo);
  out["text"] = outcome.figures.text();
  return out;
}

std::string free_log_name(const Project& project) {
  std::error_code error;
  std::string name = "feel.csv";
  for (int k = 2; std::filesystem::exists(std::filesystem::symlink_status(project.folder() / name, error)); ++k) {
    name = "feel_" + std::to_string(k) + ".csv";
  }
  return name;
}

}  // namespace asperity::studio
