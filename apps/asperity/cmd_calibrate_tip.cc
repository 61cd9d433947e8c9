#include <fmt/format.h>

#include <memory>

#include "asperity/calibration/calibrate_tip.h"
#include "asperity/recording/read_recording.h"
#include "calibrate_command.h"
#include "commands.h"

namespace asperity::app {

namespace {

class CalibrateTipCommand : public CalibrateCommand {
 public:
  explicit CalibrateTipCommand(Parser& calibrate)
      : CalibrateCommand(calibrate, "tip", "Position of the tip on the probe, from swings with the tip in a dimple") {
    require(parser().add_option("REC", recording_, "The recording's folder"));
  }

  std::vector<ConfigField> fields() override { return list_fields("calibration", config_); }

 private:
  CalibrateOutcome calibrate(const Observer& observer) override {
    reads(recording_);
    const Recording recording = read_recording(recording_, {}, observer);
    observer.update("fitting", 0.3);
    const TipCalibration tip = calibrate_tip(recording.tracker, recording.calibration.tracker, config_);
    CalibrateOutcome out;
    out.values = {{"tip_in_marker_m", json_of(tip.tip_in_marker_m)}, {"dimple_world_m", json_of(tip.dimple_world_m)}};
    out.standard_errors = {{"tip_in_marker_m", json_of(tip.stderr_m)},
                           {"dimple_world_m", json_of(tip.dimple_stderr_m)}};
    out.residuals = {{"rms_m", tip.rms_m}, {"expected_rms_m", tip.expected_rms_m}, {"noise_ratio", tip.noise_ratio}};
    Json stretches = Json::array();
    for (const TimeStretch& stretch : tip.used_stretches) stretches.push_back({stretch.start_ns, stretch.end_ns});
    out.details = {{"covariance_m2", json_of_rows(tip.covariance_m2)},
                   {"spread", tip.spread},
                   {"worst_direction", json_of(tip.worst_direction)},
                   {"poses", tip.poses},
                   {"used", tip.used},
                   {"independent_poses", tip.independent_poses},
                   {"used_stretches_ns", stretches}};
    for (int axis = 0; axis < 3; ++axis) {
      out.table.push_back({fmt::format("tip {} in the marker", "xyz"[axis]), 1e3 * tip.tip_in_marker_m[axis],
                           1e3 * tip.stderr_m[axis], "mm"});
    }
    for (int axis = 0; axis < 3; ++axis) {
      out.table.push_back({fmt::format("dimple {} in the world", "xyz"[axis]), 1e3 * tip.dimple_world_m[axis],
                           1e3 * tip.dimple_stderr_m[axis], "mm"});
    }
    out.table.push_back({"residual (RMS)", 1e3 * tip.rms_m, std::nan(""),
                         fmt::format("mm; the tracker's stated noise gives {:.3g} mm", 1e3 * tip.expected_rms_m)});
    out.notes.push_back(
        fmt::format("{} of {} poses have the tip in the dimple; their errors count as those of {:.0f} independent ones",
                    tip.used, tip.poses, tip.independent_poses));
    out.notes.emplace_back("the tip is the point that does not move: the centre of its ball if it has one");
    out.verdict = tip.verdict;
    out.store = [place_m = tip.tip_in_marker_m, sigma_m = tip.stderr_m](Calibration& calibration) {
      calibration.tip_in_marker_m = place_m;
      calibration.tip_sigma_m = sigma_m;
    };
    return out;
  }

  std::string recording_;
  CalibrateTipConfig config_;
};

}  // namespace

std::unique_ptr<Command> make_calibrate_tip(Parser& calibrate) {
  return std::make_unique<CalibrateTipCommand>(calibrate);
}

}  // namespace asperity::app
