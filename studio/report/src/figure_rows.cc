#include "figure_rows.h"

namespace asperity::studio {

namespace {

constexpr double kMilli = 1e3;
constexpr double kMicro = 1e6;
constexpr double kPercent = 100.0;

constexpr FigureRow mm(std::string_view key, std::string_view label) { return {key, label, "mm", kMilli}; }
constexpr FigureRow um(std::string_view key, std::string_view label) { return {key, label, "µm", kMicro}; }
constexpr FigureRow mmps(std::string_view key, std::string_view label) { return {key, label, "mm/s", kMilli}; }
constexpr FigureRow ms(std::string_view key, std::string_view label) { return {key, label, "ms", kMilli}; }
constexpr FigureRow pure(std::string_view key, std::string_view label, std::string_view unit = {}) {
  return {key, label, unit};
}
constexpr FigureRow count(std::string_view key, std::string_view label) {
  return {key, label, {}, 1.0, {}, {}, {}, FigureKind::kCount};
}
constexpr FigureRow yes_no(std::string_view key, std::string_view label) {
  return {key, label, {}, 1.0, {}, {}, {}, FigureKind::kYesNo};
}
constexpr FigureRow text(std::string_view key, std::string_view label) {
  return {key, label, {}, 1.0, {}, {}, {}, FigureKind::kText};
}

constexpr FigureRow with_error(FigureRow row, std::string_view error) {
  row.error = error;
  return row;
}
constexpr FigureRow only_if(FigureRow row, std::string_view condition) {
  row.only_if = condition;
  return row;
}
constexpr FigureRow hinted(FigureRow row, std::string_view hint) {
  row.hint = hint;
  return row;
}

constexpr FigureRow kScan[] = {
    mm("profile.length_m", "Length of the profile"),
    {"profile.covered", "Of it with heights", "%", kPercent},
    count("profile.gaps", "Gaps"),
    um("profile.spacing_m", "Distance of the heights"),
    mm("length_m", "Path travelled"),
    pure("duration_s", "Duration", "s"),
    mmps("speed_mps.mean", "Mean speed"),
    mmps("speed_mps.lowest", "Lowest speed"),
    mmps("speed_mps.highest", "Highest speed"),
    count("samples.probe", "Samples of the probe"),
    count("samples.tracker", "Poses of the tracker"),
};

constexpr FigureRow kRoughness[] = {
    hinted(um("roughness.Ra_m", "Ra"), "mean of the height's magnitude"),
    hinted(um("roughness.Rq_m", "Rq"), "root mean square of the height"),
    hinted(um("roughness.Rz_m", "Rz"), "mean of the sections' largest height differences"),
    hinted(um("roughness.Rt_m", "Rt"), "largest height difference"),
    hinted(pure("roughness.Rsk", "Rsk"), "skewness of the heights"),
    hinted(pure("roughness.Rku", "Rku"), "kurtosis of the heights"),
    hinted(mm("roughness.RSm_m", "RSm"), "mean width of the profile's elements"),
    hinted(um("roughness.R5p_m", "R5p"), "mean of the five highest peaks"),
    hinted(um("roughness.R5v_m", "R5v"), "mean depth of the five deepest pits"),
    hinted(um("roughness.R10z_m", "R10z"), "ten-point height"),
    hinted(um("roughness.Rcm10_m", "Rcm(10 %)"), "height above which 10 % of the material is"),
    hinted(um("roughness.Rcm50_m", "Rcm(50 %)"), "height above which 50 % of the material is"),
    hinted(um("roughness.Rcm90_m", "Rcm(90 %)"), "height above which 90 % of the material is"),
    hinted(count("roughness.missing", "Heights missing"), "how many heights of the profile are gaps"),
};

constexpr std::string_view kPeriodic = "periodicity.periodic";
constexpr FigureRow kPattern[] = {
    yes_no(kPeriodic, "Periodic"),
    only_if(with_error(mm("periodicity.pitch_m", "Pitch"), "periodicity.pitch_stderr_m"), kPeriodic),
    only_if(with_error(um("periodicity.depth_m", "Depth"), "periodicity.depth_stderr_m"), kPeriodic),
    only_if(count("periodicity.periods", "Whole periods"), kPeriodic),
    only_if(
        hinted(pure("periodicity.strength", "Likeness of the periods"), "autocorrelation at one pitch; 1: all alike"),
        kPeriodic),
};

constexpr std::string_view kMeasured = "stiffness.measured";
constexpr FigureRow kYielding[] = {
    hinted(pure("compliance.k_c", "Compliance coefficient k_c"), "1 for stiff, towards 0 for soft"),
    pure("compliance.sigma_r2", "Variance of force over acceleration"),
    with_error(pure("compliance.force_exponent", "That ratio as a power of the force"),
               "compliance.force_exponent_stderr"),
    count("compliance.windows", "Windows"),
    only_if(
        with_error(pure("stiffness.stiffness_N_per_mm", "Stiffness", "N/mm"), "stiffness.stiffness_stderr_N_per_mm"),
        kMeasured),
    only_if(hinted(pure("stiffness.lower_bound_N_per_mm", "Stiffness, at least", "N/mm"), "with 97.5 % probability"),
            "!stiffness.measured"),
    with_error({"stiffness.compliance_mm_per_N", "Compliance", "µm/N", kMilli}, "stiffness.compliance_stderr_mm_per_N"),
    pure("stiffness.force_rms_N", "Variation of the force, RMS", "N"),
    pure("stiffness.used_s", "Time in contact that was used", "s"),
    text("stiffness.verdict", "In words"),
};

constexpr FigureRow kTruth[] = {
    um("accuracy.position_rms_m", "Position, RMS"),
    um("accuracy.tracker_rms_m", "Position by the tracker alone, RMS"),
    pure("accuracy.position_error_over_sigma", "Error over stated uncertainty"),
    pure("accuracy.correlation", "Correlation of the profiles"),
    pure("accuracy.gain", "Gain"),
    pure("accuracy.rms_um", "Difference of the profiles, RMS", "µm"),
    pure("accuracy.true_rms_um", "True profile, RMS", "µm"),
    pure("accuracy.length_error_percent", "Error of the length", "%"),
    mm("accuracy.shift_m", "Shift between the two"),
    pure("accuracy.band_high_cycles_per_mm", "Compared up to", "cycles/mm"),
    mm("accuracy.compared_m", "Compared length"),
};

constexpr FigureRow kTexture[] = {
    pure("texture.length_mm", "Length", "mm"),
    count("texture.harmonics", "Harmonics"),
    um("texture.rms_height_m", "Height, RMS"),
    um("texture.rms_error_m", "Error of the model, RMS"),
    hinted(um("texture.lift_m", "Lift"), "the lowest height below the mean"),
};

constexpr FigureRow kBase[] = {
    text("base.shape", "Shape"),
    pure("base.shape_probability", "Probability of that shape"),
    with_error(mm("base.radius_m", "Radius"), "base.radius_stderr_m"),
    pure("base.normal_sigma_deg", "Uncertainty of the normal", "°"),
    pure("base.probe_tilt_deg", "Tilt of the probe", "°"),
    um("base.base_rms_m", "Departure from the shape, RMS"),
    count("base.turning_points", "Turning points"),
};

constexpr FigureRow kTrajectory[] = {
    count("trajectory.poses_used", "Poses used"),
    count("trajectory.poses_outlying", "Poses that disagree"),
    {"trajectory.poses_outlying_share", "Of all poses", "%", kPercent},
    count("trajectory.rejected_samples", "Probe samples rejected"),
    {"trajectory.probe_saturated_share", "Probe samples at their limit", "%", kPercent},
    with_error(ms("trajectory.latency_s", "Latency of the tracker"), "trajectory.latency_sigma_s"),
    hinted(pure("trajectory.latency_prior_sigmas", "Latency off the calibrated one", "σ"),
           "in standard deviations of the calibration"),
    ms("trajectory.probe_latency_s", "Latency of the probe"),
    um("trajectory.tracker_sigma_x_m", "Noise of the tracker, x"),
    um("trajectory.tracker_sigma_y_m", "Noise of the tracker, y"),
    um("trajectory.tracker_sigma_z_m", "Noise of the tracker, z"),
    pure("trajectory.tracker_noise_ratio", "Noise of the tracker over the calibrated one"),
    um("trajectory.position_residual_median_m", "Residual of the positions, median"),
    {"trajectory.rotation_residual_median_rad", "Residual of the rotations, median", "mrad", kMilli},
    pure("trajectory.process_noise_scale", "Scale of the process noise"),
    pure("trajectory.angular_accel_radps2_rtHz", "Angular acceleration", "rad/s²/√Hz"),
    pure("trajectory.accel_bias_mps2", "Bias of the accelerometer", "m/s²"),
    pure("trajectory.accel_noise_mps2", "Noise of the accelerometer", "m/s²"),
    mm("trajectory.accelerometer_position_x_m", "Place of the accelerometer, x"),
    mm("trajectory.accelerometer_position_y_m", "Place of the accelerometer, y"),
    mm("trajectory.accelerometer_position_z_m", "Place of the accelerometer, z"),
    pure("trajectory.probe_rate_Hz", "Rate of the probe", "Hz"),
    {"trajectory.probe_clock_jitter_s", "Jitter of the probe's clock", "µs", kMicro},
    ms("trajectory.longest_tracker_gap_s", "Longest time without a pose"),
    mmps("trajectory.scan_speed_mps", "Scanning velocity"),
};

constexpr FigureGroup kGroups[] = {
    {"Scan", kScan},
    {"Roughness", kRoughness},
    {"Pattern", kPattern},
    {"Compliance and stiffness", kYielding},
    {"Against the truth", kTruth},
    {"Texture for rendering", kTexture},
    {"Base shape", kBase},
    {"Trajectory", kTrajectory},
};

}  // namespace

std::span<const FigureGroup> figure_groups() { return kGroups; }

}  // namespace asperity::studio
