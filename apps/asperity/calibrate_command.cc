#include "calibrate_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "asperity/base/interval_text.h"
#include "asperity/base/text.h"
#include "asperity/base/version.h"
#include "asperity/json/config_json.h"
#include "asperity/recording/read_recording.h"
#include "asperity/recording/write_recording.h"
#include "asperity/session/our_file.h"
#include "asperity/verdict/verdict_json.h"

namespace asperity::app {

namespace fs = std::filesystem;
namespace {

bool begins_as_calibration(std::string_view begin) {
  std::string dense;
  std::copy_if(begin.begin(), begin.end(), std::back_inserter(dense),
               [](char c) { return c != ' ' && c != '\n' && c != '\r' && c != '\t'; });
  return dense.starts_with(R"({"format":"asperity-calibration",)");
}

// Counts taken for SI units and a tip at the marker's origin: what has not been calibrated claims nothing.
Calibration neutral_calibration() {
  Calibration out;
  out.accelerometer.B = Eigen::Matrix3d::Identity();
  out.accelerometer.rotation_known = false;
  return out;
}

Calibration calibration_before(const fs::path& file) {
  std::error_code ignored;
  if (!fs::exists(file, ignored) || fs::file_size(file, ignored) == 0) return neutral_calibration();
  return read_calibration(file);
}

}  // namespace

CalibrateCommand::CalibrateCommand(Parser& calibrate, const std::string& kind, const std::string& description)
    : Command(calibrate, kind, description), kind_(kind) {
  parser()
      .add_option("-o,--output", output_, "File to write the values to; the values of other kinds in it are kept")
      ->type_name("calibration.json");
}

int CalibrateCommand::run(const Observer& observer) {
  Calibration before;
  if (!output_.empty()) {
    refuse_stranger(output_, begins_as_calibration, inputs());
    before = calibration_before(output_);
  }
  if (const std::vector<std::string> read = inputs(); read.size() == 1) reads(read.front());
  const CalibrateOutcome outcome = calibrate(observer);
  reads("");
  if (!output_.empty()) write(before, outcome);
  print_json(report(outcome).dump_repaired(2));
  say(text(outcome));
  for (const Verdict& verdict : outcome.verdict.verdicts) {
    if (verdict.severity != Severity::kNote) print_error(kind_ + ": " + verdict_line(verdict));
  }
  return outcome.verdict.trustworthy ? kDone : kNotTrustworthy;
}

void CalibrateCommand::write(const Calibration& before, const CalibrateOutcome& outcome) {
  Calibration calibration = before;
  outcome.store(calibration);
  const Json details = {
      {"values", outcome.values},
      {"stderr", outcome.standard_errors},
      {"residuals", outcome.residuals},
      {"config", config_json(fields())},
      {"verdicts", verdicts_json(outcome.verdict.verdicts)},
      {"asperity", kVersion},
  };
  calibration.calibrated[kind_] = {outcome.verdict.trustworthy, outcome.verdict.text, details};
  write_calibration(output_, calibration);
}

Json CalibrateCommand::report(const CalibrateOutcome& outcome) {
  Json out;
  out["format"] = "asperity-calibrate";
  out["version"] = 1;
  out["kind"] = kind_;
  out["values"] = outcome.values;
  out["stderr"] = outcome.standard_errors;
  out["residuals"] = outcome.residuals;
  out["trustworthy"] = outcome.verdict.trustworthy;
  out["verdict"] = outcome.verdict.text;
  out["verdicts"] = verdicts_json(outcome.verdict.verdicts);
  out["notes"] = outcome.notes;
  for (const auto& [key, value] : outcome.details.items()) out[key] = value;
  if (!output_.empty()) out["file"] = output_;
  out["config"] = config_json(fields());
  out["asperity"] = kVersion;
  return out;
}

std::string CalibrateCommand::text(const CalibrateOutcome& outcome) const {
  std::size_t width = 0;
  for (const CalibratedValue& row : outcome.table) width = std::max(width, row.name.size());
  std::string out;
  for (const CalibratedValue& row : outcome.table) {
    const IntervalText shown = interval_parts(row.value, row.standard_error, 3, 7);
    out += fmt::format("{:<{}} {:>13} {:<14} {}\n", row.name, width, shown.value,
                       shown.error.empty() ? "" : "± " + shown.error, row.unit);
  }
  for (const std::string& note : outcome.notes) out += "note: " + note + "\n";
  const std::string_view word = verdict_word(outcome.verdict.verdicts);
  out += (word == "valid" ? "good: " : word == "limited" ? "LIMITED: " : "INVALID: ") + outcome.verdict.text + "\n";
  if (!output_.empty()) out += printable(output_, 200) + ": " + kind_ + " written\n";
  return out;
}

}  // namespace asperity::app
