#include "feel/feel_json.h"

#include <array>
#include <cmath>
#include <filesystem>

#include "feel/feel_setup.h"

namespace asperity::studio {

namespace {

constexpr std::array<const char*, 4> kEnds{"its time was over", "the way was at its end", "stopped", "fault"};
constexpr std::array<const char*, 6> kTypes{"bool", "integer", "number", "text", "choice", "numbers"};

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(); }

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

Json fields_json(const std::vector<ConfigField>& fields) {
  Json out = Json::array();
  for (const ConfigField& field : fields) {
    Json each;
    each["path"] = field.path;
    each["type"] = kTypes.at(static_cast<std::size_t>(field.type));
    each["description"] = field.description;
    each["low"] = number(field.range.low);
    each["high"] = number(field.range.high);
    each["choices"] = field.choices;
    // TOML's numbers, lists, flags and plain texts are JSON too.
    const Json value = Json::parse(field.get(), nullptr, false);
    each["value"] = value.is_discarded() ? Json(field.get()) : value;
    each["live"] = is_live(field.path);
    out.push_back(std::move(each));
  }
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
