#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "asperity/base/output.h"
#include "asperity/base/text.h"
#include "asperity/base/units.h"
#include "asperity/calibration/calibrate_tracker_noise.h"
#include "asperity/recording/read_recording.h"
#include "asperity/session/our_file.h"
#include "calibrate_command.h"
#include "commands.h"
#include "json_of.h"
#include "noise_figure.h"

namespace asperity::app {

namespace {

Json json_of_noise(const SeriesNoise& noise, const std::string& unit) {
  return {{"samples", noise.samples},
          {"white_" + unit, noise.white},
          {"white_stderr_" + unit, noise.white_error},
          {"slow_" + unit, noise.slow},
          {"slow_stderr_" + unit, number_or_null(noise.slow_error)},
          {"slow_time_s", noise.slow_time_s},
          {"total_" + unit, noise.total},
          {"effective_samples", noise.effective_samples},
          {"skewness", noise.skewness},
          {"excess_kurtosis", noise.excess_kurtosis},
          {"anderson_darling", noise.anderson_darling},
          {"gaussian_probability", number_or_null(noise.gaussian_probability)}};
}

Json json_of_axes(const std::array<SeriesNoise, 3>& axes, const std::string& unit) {
  Json out = Json::array();
  for (const SeriesNoise& noise : axes) out.push_back(json_of_noise(noise, unit));
  return out;
}

Json json_of_rest(const StaticInterval& rest) {
  return {{"recording", printable(rest.recording, 200)},
          {"start_ns", rest.start_ns},
          {"end_ns", rest.end_ns},
          {"outliers", rest.outliers},
          {"distance_m", rest.distance_m},
          {"tilt_rad", rest.tilt_rad},
          {"position", json_of_axes(rest.position_m, "m")},
          {"rotation", json_of_axes(rest.rotation_rad, "rad")}};
}

class CalibrateTrackerCommand : public CalibrateCommand {
 public:
  explicit CalibrateTrackerCommand(Parser& calibrate)
      : CalibrateCommand(calibrate, "tracker", "The tracker's noise, from recordings with static intervals") {
    require(parser().add_option("REC", folders_, "Recordings; their static intervals are found"));
    parser().add_option("--figure", figure_, "Write histograms of the longest static interval")->type_name("FILE.svg");
  }

  std::vector<ConfigField> fields() override { return list_fields("calibration", config_); }

 private:
  std::vector<std::string> inputs() const override { return folders_; }

  CalibrateOutcome calibrate(const Observer& observer) override {
    if (!figure_.empty()) refuse_stranger(figure_, kNoiseSvgBegin, folders_);
    std::vector<Recording> recordings;
    for (const std::string& folder : folders_) {
      observer.update("reading", static_cast<double>(recordings.size()) / static_cast<double>(folders_.size()));
      recordings.push_back(read_recording(folder, {}, observer));
    }
    std::vector<StaticTracker> trackers;
    for (std::size_t i = 0; i < recordings.size(); ++i) {
      trackers.push_back({printable(folders_[i], 200), &recordings[i].tracker, recordings[i].calibration.markers,
                          recordings[i].info.world == "camera"});
    }
    const TrackerNoise noise = calibrate_tracker_noise(trackers, config_);
    if (!figure_.empty()) {
      const auto longest = std::max_element(
          noise.rests.begin(), noise.rests.end(),
          [](const StaticInterval& a, const StaticInterval& b) { return a.deviation_m.size() < b.deviation_m.size(); });
      write_file(figure_, noise_svg(*longest));
    }
    return describe(noise);
  }

  static CalibrateOutcome describe(const TrackerNoise& noise) {
    CalibrateOutcome out;
    out.values = {{"sigma_position_m", json_of(noise.sigma_position_m)},
                  {"sigma_rotation_rad", json_of(noise.sigma_rotation_rad)}};
    out.standard_errors = {{"sigma_position_m", json_of(noise.sigma_position_error_m)},
                           {"sigma_rotation_rad", json_of(noise.sigma_rotation_error_rad)}};
    out.residuals = {{"slow_position_m", json_of(noise.slow_position_m)},
                     {"slow_rotation_rad", json_of(noise.slow_rotation_rad)}};
    Json rests = Json::array();
    for (const StaticInterval& rest : noise.rests) rests.push_back(json_of_rest(rest));
    out.details = {{"gaussian", noise.gaussian}, {"moving", noise.moving}, {"rests", rests}};
    out.details["model"] = noise.model ? noise_model_json(*noise.model) : Json(nullptr);
    constexpr double kMilli = 1e3;
    for (int axis = 0; axis < 3; ++axis) {
      out.table.push_back({fmt::format("position {}", "xyz"[axis]), kMilli * noise.sigma_position_m[axis],
                           kMilli * noise.sigma_position_error_m[axis], "mm"});
    }
    for (int axis = 0; axis < 3; ++axis) {
      out.table.push_back({fmt::format("rotation {}", "xyz"[axis]), kMilli * noise.sigma_rotation_rad[axis],
                           kMilli * noise.sigma_rotation_error_rad[axis], "mrad"});
    }
    for (const StaticInterval& rest : noise.rests) {
      std::string note =
          fmt::format("static interval of {:.1f} s, {} poses",
                      static_cast<double>(rest.end_ns - rest.start_ns) * kNanosecond_s, rest.deviation_m.size());
      if (rest.distance_m > 0.0) {
        note += fmt::format(", {:.0f} mm away, tilted by {:.0f} degrees", kMilli * rest.distance_m,
                            rest.tilt_rad * 180.0 / std::numbers::pi);
      }
      out.notes.push_back(note);
    }
    for (const Problem& problem : noise.problems) out.notes.push_back(problem.message);
    if (noise.model) {
      const TrackerNoiseModel& m = *noise.model;
      out.notes.push_back(
          fmt::format("at 1 m facing the camera: {:.3g} mm across the ray (grows with distance to the power {:.2f} ± "
                      "{:.2f}), {:.3g} mm along it ({:.2f} ± {:.2f})",
                      kMilli * m.across_m.scale, m.across_m.measured_power, m.across_m.measured_power_error,
                      kMilli * m.along_m.scale, m.along_m.measured_power, m.along_m.measured_power_error));
    } else {
      out.notes.push_back("no law over distance and tilt: " + noise.no_model_because);
    }
    out.verdict = noise.verdict;
    out.store = [noise](Calibration& calibration) {
      calibration.tracker.sigma_position_m = noise.sigma_position_m;
      calibration.tracker.sigma_rotation_rad = noise.sigma_rotation_rad;
      calibration.tracker.noise_model = noise.model;
      if (!noise.moving) calibration.tracker.slow_sigma_m = noise.slow_position_m;
      calibration.extra.erase("tracker_sigma_from");   // of an import
      calibration.extra.erase("tracker_noise_model");  // of another form than ours, with other figures
    };
    return out;
  }

  std::vector<std::string> folders_;
  std::string figure_;
  TrackerNoiseConfig config_;
};

}  // namespace

std::unique_ptr<Command> make_calibrate_tracker(Parser& calibrate) {
  return std::make_unique<CalibrateTrackerCommand>(calibrate);
}

}  // namespace asperity::app
