#include <fmt/format.h>

#include <memory>

#include "asperity/calibration/fit_force_line.h"
#include "asperity/calibration/read_force_points.h"
#include "calibrate_command.h"
#include "commands.h"

namespace asperity::app {

namespace {

class CalibrateForceCommand : public CalibrateCommand {
 public:
  explicit CalibrateForceCommand(Parser& calibrate)
      : CalibrateCommand(calibrate, "force", "The force sensor's line from readings under known forces") {
    require(parser().add_option("CSV", file_, "A table counts,force_N"));
  }

  std::vector<ConfigField> fields() override { return list_fields("calibration", config_); }

 private:
  std::vector<std::string> inputs() const override { return {file_}; }

  CalibrateOutcome calibrate(const Observer&) override {
    const ForceLineFit fit = fit_force_line(read_force_points(file_), config_);
    CalibrateOutcome out;
    out.values = {{"newton_per_count", fit.force.newton_per_count}, {"offset_newton", fit.force.offset_newton}};
    out.standard_errors = {{"newton_per_count", fit.newton_per_count_stderr},
                           {"offset_newton", fit.offset_newton_stderr}};
    out.residuals = {{"residual_newton", fit.force.residual_newton},
                     {"degrees_of_freedom", fit.degrees_of_freedom},
                     {"counts_error_newton", fit.counts_error_newton},
                     {"bend_newton", fit.bend_newton},
                     {"bend_probability", fit.bend_probability}};
    out.details = {{"points", fit.points},
                   {"correlation", fit.correlation},
                   {"outliers", fit.outliers},
                   {"saturated", fit.saturated}};
    out.table = {{"newton_per_count", fit.force.newton_per_count, fit.newton_per_count_stderr, "N/count"},
                 {"offset_newton", fit.force.offset_newton, fit.offset_newton_stderr, "N"},
                 {"residual", fit.force.residual_newton, std::nan(""),
                  fmt::format("N, {} degrees of freedom", fit.degrees_of_freedom)}};
    out.notes.push_back(
        fmt::format("the counts are rounded by {:.2g} N, which the standard errors hold", fit.counts_error_newton));
    out.verdict = fit.verdict;
    out.store = [force = fit.force](Calibration& calibration) {
      const auto axis = calibration.force.axis_in_marker;
      calibration.force = force;
      calibration.force.axis_in_marker = axis;
    };
    return out;
  }

  std::string file_;
  FitForceLineConfig config_;
};

}  // namespace

std::unique_ptr<Command> make_calibrate_force(Parser& calibrate) {
  return std::make_unique<CalibrateForceCommand>(calibrate);
}

}  // namespace asperity::app
