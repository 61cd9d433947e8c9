#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>

#include "asperity/calibration/calibrate_accelerometer_field.h"
#include "asperity/calibration/find_gyroscope_offset.h"
#include "asperity/calibration/fit_accelerometer.h"
#include "asperity/calibration/read_accelerometer_samples.h"
#include "asperity/recording/read_recording.h"
#include "calibrate_command.h"
#include "commands.h"

namespace asperity::app {

namespace {

struct AccelSettings {
  AccelerometerFieldConfig field;
  FitAccelerometerConfig known;

  template <class V>
  void visit(V& v) {
    field.visit(v);
    v.group("known", known);
  }
};

void store_accelerometer(Calibration& calibration, AccelerometerCalibration found) {
  found.position_in_marker_m = calibration.accelerometer.position_in_marker_m;
  found.position_sigma_m = calibration.accelerometer.position_sigma_m;
  calibration.accelerometer = std::move(found);
}

// B, C and the deviations of the fit, under the names of calibration.json.
void describe_model(CalibrateOutcome& out, const AccelerometerCalibration& accelerometer) {
  const Eigen::Index width = accelerometer.B.cols();
  out.values["model"] = kAccelerometerChoiceNames[1 + static_cast<std::size_t>(accelerometer.model)];
  out.values["B"] = json_of_rows(accelerometer.B);
  out.values["C"] = json_of(accelerometer.C);
  out.standard_errors["B"] = json_of_rows(accelerometer.standard_errors.leftCols(width));
  out.standard_errors["C"] = json_of(accelerometer.standard_errors.col(width));
  out.residuals["residual_counts"] = json_of(accelerometer.residual_counts);
}

class CalibrateAccelCommand : public CalibrateCommand {
 public:
  explicit CalibrateAccelCommand(Parser& calibrate)
      : CalibrateCommand(calibrate, "accel", "The accelerometer, from gravity in static poses or a known force") {
    require(parser().add_option(
        "FILE", file_,
        "t_s,accel_i,accel_j,accel_k and, if known, fx_mps2,fy_mps2,fz_mps2; bare numbers t i j k; or a recording"));
  }

  std::vector<ConfigField> fields() override { return list_fields("calibration", settings_); }

 private:
  std::vector<std::string> inputs() const override { return {file_}; }

  CalibrateOutcome calibrate(const Observer& observer) override {
    std::optional<Recording> recording;
    if (std::filesystem::is_directory(file_)) recording = read_probe_recording(file_);
    const AccelerometerFile file = recording ? accelerometer_samples_of(*recording) : read_accelerometer_samples(file_);
    observer.update("fitting", 0.5);
    CalibrateOutcome out;
    if (file.samples.force_known()) {
      out = with_known_force(file.samples);
    } else {
      out = in_the_field(file.samples, recording);
    }
    out.notes.insert(out.notes.begin(), file.notes.begin(), file.notes.end());
    return out;
  }

  CalibrateOutcome in_the_field(const AccelerometerSamples& samples, const std::optional<Recording>& recording) const {
    const AccelerometerFieldResult result = calibrate_accelerometer_field(samples, settings_.field);
    CalibrateOutcome out;
    describe_model(out, result.accelerometer);
    out.values["rotation_known"] = false;
    out.values["scale_counts_per_mps2"] = json_of(result.scale_counts_per_mps2);
    out.values["misalignment_rad"] = json_of(result.misalignment_rad);
    out.standard_errors["scale_counts_per_mps2"] = json_of(result.scale_stderr);
    out.standard_errors["misalignment_rad"] = json_of(result.misalignment_stderr_rad);
    out.residuals["rms_mps2"] = result.rms_mps2;
    out.residuals["rms_all_mps2"] = result.rms_all_mps2;
    out.residuals["degrees_of_freedom"] = result.used - 9;
    Json poses = Json::array();
    std::string left_out;
    for (const FieldPose& pose : result.poses) {
      poses.push_back({{"start_s", pose.pose.start_s},
                       {"duration_s", pose.pose.duration_s},
                       {"counts", json_of(pose.pose.mean_counts)},
                       {"drift_counts", pose.pose.drift_counts},
                       {"residual_mps2", pose.residual_mps2},
                       {"used", pose.used}});
      if (!pose.used) left_out += fmt::format("{}{:.1f} s", left_out.empty() ? "" : ", ", pose.pose.start_s);
    }
    out.details["still_counts"] = result.still_counts;
    out.details["spread"] = result.spread;
    out.details["poses"] = poses;
    for (int axis = 0; axis < 3; ++axis) {
      out.table.push_back({fmt::format("scale {}", "ijk"[axis]), result.scale_counts_per_mps2[axis],
                           result.scale_stderr[axis], "counts per m/s²"});
    }
    for (int axis = 0; axis < 3; ++axis) {
      out.table.push_back({fmt::format("bias {}", "ijk"[axis]), result.accelerometer.C[axis],
                           result.bias_stderr_counts[axis], "counts"});
    }
    constexpr const char* kPairs[3] = {"i and j", "i and k", "j and k"};
    for (int pair = 0; pair < 3; ++pair) {
      out.table.push_back({fmt::format("90° less {}", kPairs[pair]), 1e3 * result.misalignment_rad[pair],
                           1e3 * result.misalignment_stderr_rad[pair], "mrad"});
    }
    out.table.push_back({"residual", result.residual_counts, std::nan(""), "counts a pose"});
    out.table.push_back({"RMS of |a| − g", result.rms_mps2, std::nan(""),
                         fmt::format("m/s² over {} of {} poses", result.used, result.poses.size())});
    if (!left_out.empty())
      out.notes.push_back("left out, because the others contradict them: the poses at " + left_out);
    out.verdict = result.verdict;
    std::optional<GyroscopeCalibration> gyroscope;
    if (recording) gyroscope = gyroscope_at_rest(*recording, result, out);
    out.store = [accelerometer = result.accelerometer, gyroscope](Calibration& calibration) {
      store_accelerometer(calibration, accelerometer);
      if (!gyroscope) return;
      const Eigen::Vector3d offset = gyroscope->C;
      if (!calibration.gyroscope) calibration.gyroscope = gyroscope;
      calibration.gyroscope->C = offset;
    };
    return out;
  }

  // Only the offset is found; the scale is the recording's own.
  static std::optional<GyroscopeCalibration> gyroscope_at_rest(const Recording& recording,
                                                               const AccelerometerFieldResult& result,
                                                               CalibrateOutcome& out) {
    std::vector<StaticPose> poses;
    for (const FieldPose& pose : result.poses) poses.push_back(pose.pose);
    const std::optional<GyroscopeOffset> offset = find_gyroscope_offset(recording, poses);
    if (!offset) return std::nullopt;
    out.values["gyroscope_C"] = json_of(offset->counts);
    out.standard_errors["gyroscope_C"] = json_of(offset->stderr_counts);
    out.residuals["gyroscope_scatter_counts"] = json_of(offset->scatter_counts);
    for (int axis = 0; axis < 3; ++axis) {
      out.table.push_back({fmt::format("gyroscope offset {}", "ijk"[axis]), offset->counts[axis],
                           offset->stderr_counts[axis], "counts"});
    }
    if (!recording.calibration.gyroscope) {
      out.notes.emplace_back(
          "the recording states no scale of the gyroscope: its offset is written only where a calibration has one");
      return std::nullopt;
    }
    return GyroscopeCalibration{recording.calibration.gyroscope->B, offset->counts};
  }

  CalibrateOutcome with_known_force(const AccelerometerSamples& samples) const {
    const AccelerometerFit fit = fit_accelerometer(samples, settings_.known);
    CalibrateOutcome out;
    describe_model(out, fit.accelerometer);
    out.values["rotation_known"] = true;
    const AccelerometerModelFit& chosen = fit.models[fit.chosen];
    out.residuals["degrees_of_freedom"] = chosen.degrees_of_freedom;
    Json models = Json::array();
    for (const AccelerometerModelFit& model : fit.models) {
      CalibrateOutcome one;
      describe_model(one, model.accelerometer);
      models.push_back({{"model", one.values["model"]},
                        {"B", one.values["B"]},
                        {"C", one.values["C"]},
                        {"stderr", one.standard_errors},
                        {"residual_counts", one.residuals["residual_counts"]},
                        {"parameters", model.parameters},
                        {"degrees_of_freedom", model.degrees_of_freedom},
                        {"significant", model.significant},
                        {"bic", model.bic},
                        {"better_probability", model.better_probability},
                        {"dropped", model.dropped},
                        {"cofactor", json_of_rows(model.cofactor)}});
      for (int axis = 0; axis < 3; ++axis) {
        out.table.push_back({fmt::format("{} residual {}", one.values["model"].get<std::string>(), "ijk"[axis]),
                             model.accelerometer.residual_counts[axis], std::nan(""),
                             fmt::format("counts, {} degrees of freedom", model.degrees_of_freedom)});
      }
      for (const std::string& term : model.dropped) {
        out.notes.push_back(fmt::format("quadric: the poses do not determine {}, which was dropped", term));
      }
    }
    out.details = {
        {"rows", fit.rows},     {"poses", fit.poses},   {"joined", fit.joined}, {"correlation", fit.correlation},
        {"spread", fit.spread}, {"reason", fit.reason}, {"models", models}};
    constexpr const char* kTerms[9] = {"x", "y", "z", "x²", "y²", "z²", "xy", "xz", "yz"};
    const Eigen::Index width = fit.accelerometer.B.cols();
    for (int axis = 0; axis < 3; ++axis) {
      for (Eigen::Index k = 0; k < width; ++k) {
        const double error = fit.accelerometer.standard_errors(axis, k);
        if (error == 0.0 && fit.accelerometer.B(axis, k) == 0.0) continue;
        out.table.push_back({fmt::format("B {} {}", "ijk"[axis], kTerms[k]), fit.accelerometer.B(axis, k), error,
                             k < 3 ? "counts per m/s²" : "counts per (m/s²)²"});
      }
      out.table.push_back({fmt::format("C {}", "ijk"[axis]), fit.accelerometer.C[axis],
                           fit.accelerometer.standard_errors(axis, width), "counts"});
    }
    out.notes.push_back(fit.reason);
    if (fit.joined > 1) {
      out.notes.push_back(
          fmt::format("the errors of neighbouring poses are correlated: {} poses each were averaged", fit.joined));
    }
    out.verdict = fit.verdict;
    out.store = [accelerometer = fit.accelerometer](Calibration& calibration) {
      store_accelerometer(calibration, accelerometer);
    };
    return out;
  }

  std::string file_;
  AccelSettings settings_;
};

}  // namespace

std::unique_ptr<Command> make_calibrate_accel(Parser& calibrate) {
  return std::make_unique<CalibrateAccelCommand>(calibrate);
}

}  // namespace asperity::app
