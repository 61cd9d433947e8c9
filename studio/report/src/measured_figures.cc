#include "asperity/studio/measured_figures.h"

#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

namespace asperity::studio {

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kMilli = 1e3;
constexpr double kMicro = 1e6;

class List {
 public:
  void group(std::string_view name) { group_ = name; }

  void number(std::string_view key, std::string_view label, double value, std::string_view unit, double error = kNone) {
    Json& figure = begin(key, label);
    figure["value"] = std::isfinite(value) ? Json(value) : Json(nullptr);
    if (std::isfinite(error)) figure["error"] = error;
    figure["unit"] = unit;
  }
  void count(std::string_view key, std::string_view label, std::size_t value) {
    begin(key, label)["value"] = value;
    figures_.back()["unit"] = "";
    figures_.back()["count"] = true;
  }
  void text(std::string_view key, std::string_view label, std::string_view value) {
    begin(key, label)["value"] = value;
    figures_.back()["unit"] = "";
  }

  Json take() { return std::move(figures_); }

 private:
  Json& begin(std::string_view key, std::string_view label) {
    figures_.push_back({{"group", group_}, {"key", key}, {"label", label}});
    return figures_.back();
  }

  std::string group_;
  Json figures_ = Json::array();
};

void add_scan(const ProcessResult& result, List& list) {
  list.group("Scan");
  list.number("profile.length_m", "Length of the profile", kMilli * result.coverage.length_m, "mm");
  list.number("profile.covered", "Of it with heights", 100.0 * result.coverage.covered, "%");
  list.count("profile.gaps", "Gaps", result.coverage.gaps);
  list.number("length_m", "Path travelled", kMilli * result.base.length_m, "mm");
  list.number("speed_mps.mean", "Mean speed", kMilli * result.speed.mean_mps, "mm/s");
  list.number("speed_mps.lowest", "Lowest speed", kMilli * result.speed.lowest_mps, "mm/s");
  list.number("speed_mps.highest", "Highest speed", kMilli * result.speed.highest_mps, "mm/s");
}

void add_base(const BasePathResult& base, List& list) {
  list.group("Base shape");
  list.text("base.shape", "Shape", kPathShapeNames.at(static_cast<std::size_t>(base.shape)));
  list.number("base.shape_probability", "Probability of that shape", base.shape_probability, "");
  if (base.shape == PathShape::kCircle) {
    list.number("base.radius_m", "Radius", kMilli * base.radius_m, "mm", kMilli * base.radius_stderr_m);
  }
  list.number("base.normal_sigma_deg", "Uncertainty of the normal", base.normal_sigma_deg, "°");
  list.number("base.probe_tilt_deg", "Tilt of the probe", base.probe_tilt_deg, "°");
  list.number("base.base_rms_m", "Departure from the shape, RMS", kMicro * base.base_rms_m, "µm");
  list.count("base.turning_points", "Turning points", base.turning_points.size());
}

void add_roughness(const RoughnessResult& r, List& list) {
  list.group("Roughness");
  list.number("roughness.Ra_m", "Ra", kMicro * r.Ra_m, "µm");
  list.number("roughness.Rq_m", "Rq", kMicro * r.Rq_m, "µm");
  list.number("roughness.Rz_m", "Rz", kMicro * r.Rz_m, "µm");
  list.number("roughness.Rt_m", "Rt", kMicro * r.Rt_m, "µm");
  list.number("roughness.Rsk", "Rsk", r.Rsk, "");
  list.number("roughness.Rku", "Rku", r.Rku, "");
  list.number("roughness.RSm_m", "RSm", kMilli * r.RSm_m, "mm");
  list.number("roughness.R10z_m", "R10z", kMicro * r.R10z_m, "µm");
  list.number("roughness.Rcm10_m", "Rcm(10 %)", kMicro * r.Rcm10_m, "µm");
  list.number("roughness.Rcm50_m", "Rcm(50 %)", kMicro * r.Rcm50_m, "µm");
  list.number("roughness.Rcm90_m", "Rcm(90 %)", kMicro * r.Rcm90_m, "µm");
  list.count("roughness.missing", "Heights missing", r.missing);
}

void add_pattern(const Periodicity& p, List& list) {
  list.group("Pattern");
  list.text("periodicity.periodic", "Periodic", p.periodic ? "yes" : "no");
  list.number("periodicity.pitch_m", "Pitch", kMilli * p.pitch_m, "mm", kMilli * p.pitch_stderr_m);
  list.number("periodicity.depth_m", "Depth", kMicro * p.depth_m, "µm", kMicro * p.depth_stderr_m);
  list.number("periodicity.strength", "Autocorrelation at one pitch", p.strength, "");
  list.count("periodicity.periods", "Whole periods", p.periods);
}

void add_yielding(const Compliance& compliance, const StiffnessEstimate& s, List& list) {
  list.group("Compliance and stiffness");
  list.number("compliance.k_c", "Compliance coefficient k_c", compliance.k_c, "");
  list.number("compliance.sigma_r2", "Variance of the force-acceleration ratio", compliance.sigma_r2, "");
  list.number("", "Ratio as a power of the force", compliance.exponent, "", compliance.exponent_error);
  list.count("compliance.windows", "Windows", compliance.windows.size());
  if (s.measured) {
    list.number("stiffness.stiffness_N_per_mm", "Stiffness", s.stiffness_N_per_mm, "N/mm", s.stiffness_stderr_N_per_mm);
  }
  list.number("stiffness.lower_bound_N_per_mm", "Stiffness, at least (97.5 %)", s.lower_bound_N_per_mm, "N/mm");
  list.number("stiffness.compliance_mm_per_N", "Compliance", kMilli * s.compliance_mm_per_N, "µm/N",
              kMilli * s.compliance_stderr_mm_per_N);
  list.number("stiffness.force_rms_N", "Variation of the force, RMS", s.force_rms_N, "N");
  list.number("stiffness.used_s", "Time in contact that was used", s.used_s, "s");
  if (!s.verdict.empty()) list.text("stiffness.verdict", "In words", s.verdict);
}

void add_texture(const FourierFit& fit, List& list) {
  list.group("Texture for rendering");
  list.number("texture.length_mm", "Length", fit.texture.length_mm, "mm");
  list.count("texture.harmonics", "Harmonics", fit.texture.a_m.size());
  list.number("texture.rms_height_m", "Height, RMS", kMicro * fit.rms_height_m, "µm");
  list.number("texture.rms_error_m", "Error of the model, RMS", kMicro * fit.rms_error_m, "µm");
  list.number("texture.lift_m", "Lift", kMicro * fit.lift_m, "µm");
}

void add_trajectory(const TrajectoryResult& trajectory, List& list) {
  list.group("Trajectory");
  const auto figure = [&](const char* key) {
    const auto found = trajectory.figures.find(key);
    return found == trajectory.figures.end() ? kNone : found->second;
  };
  struct Row {
    const char *key, *label;
    double factor;
    const char *unit, *error;
  };
  for (const Row& row :
       {Row{"poses_used", "Poses used", 1.0, "", ""}, Row{"poses_outlying", "Poses that disagree", 1.0, "", ""},
        Row{"rejected_samples", "Probe samples rejected", 1.0, "", ""},
        Row{"latency_s", "Latency of the tracker", kMilli, "ms", "latency_sigma_s"},
        Row{"tracker_sigma_x_m", "Noise of the tracker, x", kMicro, "µm", ""},
        Row{"tracker_sigma_y_m", "Noise of the tracker, y", kMicro, "µm", ""},
        Row{"tracker_sigma_z_m", "Noise of the tracker, z", kMicro, "µm", ""},
        Row{"position_residual_median_m", "Residual of the poses, median", kMicro, "µm", ""},
        Row{"accel_bias_mps2", "Bias of the accelerometer", 1.0, "m/s²", ""},
        Row{"accel_noise_mps2", "Noise of the accelerometer", 1.0, "m/s²", ""},
        Row{"probe_rate_Hz", "Rate of the probe", 1.0, "Hz", ""},
        Row{"probe_clock_jitter_s", "Jitter of the probe's clock", kMicro, "µs", ""},
        Row{"longest_tracker_gap_s", "Longest time without a pose", kMilli, "ms", ""},
        Row{"scan_speed_mps", "Scanning velocity", kMilli, "mm/s", ""}}) {
    if (!trajectory.figures.contains(row.key)) continue;
    const std::string key = std::string("trajectory.") + row.key;
    if (std::string_view(row.unit).empty()) {
      list.count(key, row.label, static_cast<std::size_t>(figure(row.key)));
    } else {
      list.number(key, row.label, row.factor * figure(row.key), row.unit, row.factor * figure(row.error));
    }
  }
}

void add_accuracy(const Accuracy& accuracy, List& list) {
  list.group("Against the truth");
  list.number("accuracy.position_rms_m", "Position, RMS", kMicro * accuracy.position_rms_m, "µm");
  list.number("accuracy.tracker_rms_m", "Position by the tracker alone, RMS", kMicro * accuracy.tracker_rms_m, "µm");
  list.number("accuracy.position_error_over_sigma", "Error over stated uncertainty", accuracy.position_error_over_sigma,
              "");
  if (!accuracy.profile) return;
  const ProfileComparison& p = *accuracy.profile;
  list.number("accuracy.correlation", "Correlation of the profiles", p.correlation, "");
  list.number("accuracy.gain", "Gain", p.gain, "");
  list.number("accuracy.rms_um", "Difference of the profiles, RMS", p.rms_um, "µm");
  list.number("accuracy.true_rms_um", "True profile, RMS", p.true_rms_um, "µm");
  list.number("accuracy.length_error_percent", "Error of the length", p.length_error_percent, "%");
  list.number("accuracy.shift_m", "Shift between the two", kMilli * p.shift_m, "mm");
  list.number("accuracy.band_high_cycles_per_mm", "Compared up to", accuracy.band_high_cycles_per_mm, "cycles/mm");
  list.number("accuracy.compared_m", "Compared length", kMilli * p.compared_m, "mm");
}

}  // namespace

Json measured_figures(const ProcessResult& result) {
  List list;
  add_scan(result, list);
  if (result.roughness) add_roughness(*result.roughness, list);
  add_pattern(result.periodicity, list);
  add_yielding(result.compliance, result.stiffness, list);
  if (result.accuracy) add_accuracy(*result.accuracy, list);
  if (result.fit) add_texture(*result.fit, list);
  if (result.base.path.size() > 0) add_base(result.base, list);
  add_trajectory(result.trajectory, list);
  return list.take();
}

}  // namespace asperity::studio
