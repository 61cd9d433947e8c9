#pragma once

#include <functional>
#include <string>
#include <vector>

#include "asperity/calibration/calibration_verdict.h"
#include "asperity/json/json.h"
#include "asperity/recording/calibration.h"
#include "command.h"
#include "json_of.h"

namespace asperity::app {

// One line of the table for a person: "name  value ± standard error unit". A standard error that is nan is not
// printed: the value was not estimated, or has none.
struct CalibratedValue {
  std::string name;
  double value = 0.0;
  double standard_error = 0.0;
  std::string unit;
};

// What one kind of calibration found: once for a program, once for a person, and how a calibration takes it.
struct CalibrateOutcome {
  Json values = Json::object();           // units in the key names
  Json standard_errors = Json::object();  // under the keys of `values`, of the same shapes
  Json residuals = Json::object();        // what the fit leaves, with the degrees of freedom
  Json details = Json::object();          // whatever else; further members of what --json prints
  std::vector<CalibratedValue> table;
  std::vector<std::string> notes;  // one sentence each
  CalibrationVerdict verdict;
  // Puts the values in their place; what other kinds have calibrated stays as it is.
  std::function<void(Calibration&)> store;
};

// `asperity calibrate KIND … [-o calibration.json]`: the part that all kinds share. A kind binds its inputs in its
// constructor, lists its settings by fields() under "calibration", and does its work in calibrate(). Data that
// cannot determine the values are refused there by an Error that says what to record instead; nothing is written then.
class CalibrateCommand : public Command {
 public:
  CalibrateCommand(Parser& calibrate, const std::string& kind, const std::string& description);

  int run(const Observer& observer) final;

 protected:
  virtual CalibrateOutcome calibrate(const Observer& observer) = 0;
  // Files that are read, which -o must therefore not replace.
  virtual std::vector<std::string> inputs() const { return {}; }

 private:
  void write(const Calibration& before, const CalibrateOutcome& outcome);
  Json report(const CalibrateOutcome& outcome);
  std::string text(const CalibrateOutcome& outcome) const;

  std::string kind_;
  std::string output_;
};

}  // namespace asperity::app
