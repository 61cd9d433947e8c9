#include "metric_rows.h"

namespace asperity::studio {

namespace {

constexpr double kMilli = 1e3;
constexpr double kMicro = 1e6;
constexpr double kPercent = 100.0;

constexpr MetricRow mm(std::string_view key, std::string_view label) { return {key, label, "mm", kMilli}; }
constexpr MetricRow um(std::string_view key, std::string_view label) { return {key, label, "µm", kMicro}; }
constexpr MetricRow mmps(std::string_view key, std::string_view label) { return {key, label, "mm/s", kMilli}; }
constexpr MetricRow ms(std::string_view key, std::string_view label) { return {key, label, "ms", kMilli}; }
constexpr MetricRow pure(std::string_view key, std::string_view label, std::string_view unit = {}) {
  return {key, label, unit};
}
constexpr MetricRow count_row(std::string_view key, std::string_view label) {
  return {key, label, {}, 1.0, {}, {}, {}, MetricKind::kCount};
}
constexpr MetricRow yes_no(std::string_view key, std::string_view label) {
  return {key, label, {}, 1.0, {}, {}, {}, MetricKind::kYesNo};
}
constexpr MetricRow text_row(std::string_view key, std::string_view label) {
  return {key, label, {}, 1.0, {}, {}, {}, MetricKind::kText};
}

constexpr MetricRow with_error(MetricRow row, std::string_view error) {
  row.error = error;
  return row;
}
constexpr MetricRow only_if(MetricRow row, std::string_view condition) {
  row.only_if = condition;
  return row;
}
constexpr MetricRow hinted(MetricRow row, std::string_view hint) {
  row.hint = hint;
  return row;
}

constexpr MetricRow kScan[] = {
    with_error(mm("profile.length_m", "Length of the profile"), "profile.length_stderr_m"),
    {"profile.covered", "Share of the profile with heights", "%", kPercent},
    count_row("profile.gaps", "Gaps"),
    um("profile.spacing_m", "Spacing of the heights"),
    with_error(mm("length_m", "Path length"), "length_stderr_m"),
    hinted(with_error(um("profile.noise_rms_m", "Noise in the texture, RMS"), "profile.noise_rms_stderr_m"),
           "part of the texture that is expected to be error"),
    hinted(pure("profile.snr", "Signal-to-noise ratio"), "power of the surface over power of the noise"),
    hinted(um("profile.at_most_m", "Texture, RMS, upper limit"), "of the surface, with 97.5 % probability"),
    pure("duration_s", "Duration", "s"),
    mmps("speed_mps.mean", "Mean speed"),
    mmps("speed_mps.lowest", "Lowest speed"),
    mmps("speed_mps.highest", "Highest speed"),
    count_row("samples.probe", "Samples of the probe"),
    count_row("samples.tracker", "Poses of the tracker"),
};

constexpr MetricRow kRoughness[] = {
    hinted(with_error(um("roughness.Ra_m", "Ra"), "roughness.Ra_stderr_m"), "mean of the height's magnitude"),
    hinted(with_error(um("roughness.Rq_m", "Rq"), "roughness.Rq_stderr_m"), "root mean square of the height"),
    hinted(with_error(um("roughness.Rz_m", "Rz"), "roughness.Rz_stderr_m"),
           "mean of the sections' largest height differences"),
    hinted(with_error(um("roughness.Rt_m", "Rt"), "roughness.Rt_stderr_m"), "largest height difference"),
    hinted(with_error(pure("roughness.Rsk", "Rsk"), "roughness.Rsk_stderr"), "skewness of the heights"),
    hinted(with_error(pure("roughness.Rku", "Rku"), "roughness.Rku_stderr"), "kurtosis of the heights"),
    hinted(with_error(mm("roughness.RSm_m", "RSm"), "roughness.RSm_stderr_m"), "mean width of the profile's elements"),
    hinted(with_error(um("roughness.R5p_m", "R5p"), "roughness.R5p_stderr_m"), "mean of the five highest peaks"),
    hinted(with_error(um("roughness.R5v_m", "R5v"), "roughness.R5v_stderr_m"), "mean depth of the five deepest pits"),
    hinted(with_error(um("roughness.R10z_m", "R10z"), "roughness.R10z_stderr_m"), "ten-point height"),
    hinted(with_error(um("roughness.Rcm10_m", "Rcm(10 %)"), "roughness.Rcm10_stderr_m"),
           "height above which 10 % of the material is"),
    hinted(with_error(um("roughness.Rcm50_m", "Rcm(50 %)"), "roughness.Rcm50_stderr_m"),
           "height above which 50 % of the material is"),
    hinted(with_error(um("roughness.Rcm90_m", "Rcm(90 %)"), "roughness.Rcm90_stderr_m"),
           "height above which 90 % of the material is"),
    hinted(count_row("roughness.missing", "Heights missing"), "heights of the profile that are gaps"),
};

constexpr std::string_view kPeriodic = "periodicity.periodic";
constexpr MetricRow kPattern[] = {
    yes_no(kPeriodic, "Periodic"),
    only_if(with_error(mm("periodicity.pitch_m", "Pitch"), "periodicity.pitch_stderr_m"), kPeriodic),
    only_if(hinted(with_error(mm("periodicity.across_pitch_m", "Pitch across the ribs"),
                              "periodicity.across_pitch_stderr_m"),
                   "of straight ribs that a bent path crosses at changing angles"),
            kPeriodic),
    only_if(with_error(um("periodicity.depth_m", "Depth"), "periodicity.depth_stderr_m"), kPeriodic),
    only_if(count_row("periodicity.periods", "Whole periods"), kPeriodic),
    only_if(
        hinted(pure("periodicity.strength", "Similarity of the periods"), "autocorrelation at one pitch; 1: all equal"),
        kPeriodic),
};

constexpr std::string_view kDetermined = "compliance.determined";
constexpr std::string_view kMeasured = "stiffness.measured";
constexpr MetricRow kYielding[] = {
    only_if(hinted(with_error(pure("compliance.k_c", "Compliance coefficient k_c"), "compliance.k_c_stderr"),
                   "1 for stiff, towards 0 for soft, for forces of 0.5 to 1.5 N"),
            kDetermined),
    only_if(pure("compliance.k_c_low", "k_c, 95 % interval, from"), kDetermined),
    only_if(pure("compliance.k_c_high", "k_c, 95 % interval, to"), kDetermined),
    with_error(pure("compliance.force_exponent", "Force over acceleration as a power of the force"),
               "compliance.force_exponent_stderr"),
    pure("compliance.lightest_N", "Smallest force of a window", "N"),
    pure("compliance.firmest_N", "Largest force of a window", "N"),
    count_row("compliance.windows", "Windows"),
    text_row("compliance.verdict", "Verdict on k_c"),
    only_if(
        with_error(pure("stiffness.stiffness_N_per_mm", "Stiffness", "N/mm"), "stiffness.stiffness_stderr_N_per_mm"),
        kMeasured),
    hinted(pure("stiffness.lower_bound_N_per_mm", "Stiffness, lower limit", "N/mm"), "with 97.5 % probability"),
    only_if(hinted(pure("stiffness.upper_bound_N_per_mm", "Stiffness, upper limit", "N/mm"), "with 97.5 % probability"),
            kMeasured),
    with_error({"stiffness.compliance_mm_per_N", "Compliance", "µm/N", kMilli}, "stiffness.compliance_stderr_mm_per_N"),
    pure("stiffness.force_rms_N", "Variation of the force, RMS", "N"),
    pure("stiffness.used_s", "Time in contact that was used", "s"),
    text_row("stiffness.verdict", "Verdict on the stiffness"),
};

constexpr MetricRow kTruth[] = {
    um("accuracy.position_rms_m", "Position error, RMS"),
    um("accuracy.tracker_rms_m", "Position error of the tracker alone, RMS"),
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

constexpr MetricRow kTexture[] = {
    pure("texture.length_mm", "Length", "mm"),
    count_row("texture.harmonics", "Harmonics"),
    um("texture.rms_height_m", "Height, RMS"),
    um("texture.rms_error_m", "Error of the model, RMS"),
    hinted(um("texture.lift_m", "Height offset"), "the lowest height below the mean"),
};

constexpr MetricRow kBase[] = {
    text_row("base.shape", "Shape"),
    pure("base.shape_probability", "Probability of that shape"),
    hinted(with_error(mm("base.radius_m", "Radius"), "base.radius_stderr_m"), "of the tip's path"),
    with_error(um("base.indentation_m", "Indentation of the tip, mean"), "base.indentation_stderr_m"),
    pure("base.normal_sigma_deg", "Uncertainty of the normal", "°"),
    pure("base.probe_tilt_deg", "Tilt of the probe", "°"),
    um("base.base_rms_m", "Deviation from the shape, RMS"),
    count_row("base.turning_points", "Reversals of the path"),
};

constexpr MetricRow kTrajectory[] = {
    count_row("trajectory.poses_used", "Poses used"),
    count_row("trajectory.poses_outlying", "Outlying poses"),
    {"trajectory.poses_outlying_share", "Share of outlying poses", "%", kPercent},
    count_row("trajectory.rejected_samples", "Probe samples rejected"),
    {"trajectory.probe_saturated_share", "Probe samples at their limit", "%", kPercent},
    with_error(ms("trajectory.latency_s", "Latency of the tracker"), "trajectory.latency_sigma_s"),
    hinted(pure("trajectory.latency_prior_sigmas", "Latency, difference from the calibrated one", "σ"),
           "in standard deviations of the calibration"),
    ms("trajectory.probe_latency_s", "Latency of the probe"),
    um("trajectory.tracker_sigma_x_m", "Noise of the tracker, x"),
    um("trajectory.tracker_sigma_y_m", "Noise of the tracker, y"),
    um("trajectory.tracker_sigma_z_m", "Noise of the tracker, z"),
    pure("trajectory.tracker_noise_ratio", "Noise of the tracker over its calibrated noise"),
    um("trajectory.position_residual_median_m", "Residual of the positions, median"),
    {"trajectory.rotation_residual_median_rad", "Residual of the rotations, median", "mrad", kMilli},
    {"trajectory.tracker_time_sigma_s", "Jitter of the poses' times", "µs", kMicro},
    um("trajectory.tracker_slow_sigma_m", "Drift of the tracker"),
    pure("trajectory.process_noise_scale", "Scale of the process noise"),
    pure("trajectory.accel_own_noise_mps2", "Noise of the accelerometer, estimated", "m/s²"),
    {"trajectory.accel_motion_share", "Noise in proportion to the acceleration", "%", kPercent},
    {"trajectory.probe_time_sigma_s", "Jitter of the samples' times", "µs", kMicro},
    pure("trajectory.gyro_own_noise_radps", "Noise of the gyroscope, estimated", "rad/s"),
    {"trajectory.gyro_motion_share", "Noise in proportion to the angular rate", "%", kPercent},
    {"trajectory.accel_matrix_error", "Error of the accelerometer's scales and axes", "%", kPercent},
    {"trajectory.gyro_matrix_error", "Error of the gyroscope's scales and axes", "%", kPercent},
    pure("trajectory.gravity_error_mps2", "Error of gravity", "m/s²"),
    pure("trajectory.angular_accel_radps2_rtHz", "Angular acceleration", "rad/s²/√Hz"),
    pure("trajectory.accel_bias_mps2", "Bias of the accelerometer", "m/s²"),
    pure("trajectory.accel_noise_mps2", "Noise of the accelerometer", "m/s²"),
    with_error(mm("trajectory.accelerometer_position_x_m", "Position of the accelerometer, x"),
               "trajectory.accelerometer_position_x_sigma_m"),
    with_error(mm("trajectory.accelerometer_position_y_m", "Position of the accelerometer, y"),
               "trajectory.accelerometer_position_y_sigma_m"),
    with_error(mm("trajectory.accelerometer_position_z_m", "Position of the accelerometer, z"),
               "trajectory.accelerometer_position_z_sigma_m"),
    pure("trajectory.probe_rate_Hz", "Rate of the probe", "Hz"),
    {"trajectory.probe_clock_jitter_s", "Jitter of the probe's clock", "µs", kMicro},
    ms("trajectory.longest_tracker_gap_s", "Longest time without a pose"),
    mmps("trajectory.scan_speed_mps", "Scanning speed"),
};

constexpr MetricGroup kGroups[] = {
    {"Scan", kScan},
    {"Roughness", kRoughness},
    {"Pattern", kPattern},
    {"Compliance and stiffness", kYielding},
    {"Comparison with the truth", kTruth},
    {"Texture for rendering", kTexture},
    {"Base shape", kBase},
    {"Trajectory", kTrajectory},
};

}  // namespace

std::span<const MetricGroup> metric_groups() { return kGroups; }

}  // namespace asperity::studio
