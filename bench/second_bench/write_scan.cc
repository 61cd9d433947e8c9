#include <cmath>
#include <fstream>
#include <stdexcept>

#include <fmt/format.h>

#include "asperity/json/json.h"
#include "noise_sources.h"
#include "sensors.h"

namespace second_bench {

namespace {

using asperity::Json;
using Eigen::Vector3d;

Json list(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }

Json rows_of(const Eigen::MatrixXd& m) {
  Json out = Json::array();
  for (Eigen::Index r = 0; r < m.rows(); ++r) {
    Json row = Json::array();
    for (Eigen::Index c = 0; c < m.cols(); ++c) row.push_back(m(r, c));
    out.push_back(row);
  }
  return out;
}

void write(const std::filesystem::path& path, const std::string& text) {
  std::ofstream out(path, std::ios::binary);
  out << text;
  if (!out.flush()) throw std::runtime_error(path.string() + ": cannot be written");
}

std::string probe_csv(const ScanPlan& plan, const ProbeRows& probe) {
  std::string out =
      plan.open ? "t_ns,accel_i,accel_j,accel_k,force,gyro_i,gyro_j,gyro_k\n" : "t_ns,accel_i,accel_j,accel_k,force\n";
  for (const ProbeRow& row : probe.rows) {
    out += fmt::format("{},{},{},{},", row.t_ns, row.accel.x(), row.accel.y(), row.accel.z());
    if (std::isfinite(row.force)) out += fmt::format("{}", row.force);
    if (plan.open) out += fmt::format(",{},{},{}", row.gyro.x(), row.gyro.y(), row.gyro.z());
    out += '\n';
  }
  return out;
}

std::string tracker_csv(const ScanPlan& plan, const PoseRows& poses) {
  std::string out = "t_ns,px_m,py_m,pz_m,qw,qx,qy,qz";
  if (plan.states_frame_sigmas) out += ",sigma_px_m,sigma_py_m,sigma_pz_m,sigma_rx_rad,sigma_ry_rad,sigma_rz_rad";
  out += '\n';
  for (const PoseRow& row : poses.rows) {
    out += fmt::format("{},{:.9g},{:.9g},{:.9g},{:.12g},{:.12g},{:.12g},{:.12g}", row.t_ns, row.p_m.x(), row.p_m.y(),
                       row.p_m.z(), row.q.w(), row.q.x(), row.q.y(), row.q.z());
    if (plan.states_frame_sigmas) {
      for (const Vector3d& sigma : {row.sigma_m, row.sigma_rad})
        out += fmt::format(",{:.4g},{:.4g},{:.4g}", sigma.x(), sigma.y(), sigma.z());
    }
    out += '\n';
  }
  return out;
}

std::string truth_csv(const ScanPlan& plan, const ProbeRows& probe, const HandMotion& motion) {
  std::string out = "t_ns,s_m,height_m,px_m,py_m,pz_m,qw,qx,qy,qz,force_N\n";
  const bool air = plan.family == "air";
  for (const TruthRow& row : probe.taken) {
    const std::size_t i = row.step;
    const Vector3d& p = motion.p_world_tip_m[i];
    const Eigen::Quaterniond& q = motion.q_world_marker[i];
    out += air ? fmt::format("{},,", row.t_ns)
               : fmt::format("{},{:.12g},{:.12g}", row.t_ns, motion.s_m[i], motion.height_m[i]);
    out += fmt::format(",{:.12g},{:.12g},{:.12g},{:.15g},{:.15g},{:.15g},{:.15g},{:.6g}\n", p.x(), p.y(), p.z(), q.w(),
                       q.x(), q.y(), q.z(), motion.normal_N[i]);
  }
  return out;
}

// What a careful person would have measured: the truth and an error of the size that is stated beside it.
Json calibration_json(const ScanPlan& plan, const TrueSensors& sensors, const PoseRows& poses) {
  Dice dice(plan.seed, 61);
  Eigen::MatrixXd B = sensors.accel_B, gyro_B = sensors.gyro_B;
  Vector3d C = sensors.accel_C, gyro_C = sensors.gyro_C;
  Eigen::MatrixXd stderr_counts(3, 4);
  for (Eigen::Index r = 0; r < 3; ++r) {
    const double counts_per_mps2 = sensors.accel_B.row(r).norm(), counts_per_radps = sensors.gyro_B.row(r).norm();
    for (Eigen::Index c = 0; c < 3; ++c) {
      stderr_counts(r, c) = plan.accel_scale_error * counts_per_mps2;
      B(r, c) += stderr_counts(r, c) * dice.normal();
      gyro_B(r, c) += plan.gyro_scale_error * counts_per_radps * dice.normal();
    }
    stderr_counts(r, 3) = plan.accel_offset_error_mps2 * counts_per_mps2;
    C[r] += stderr_counts(r, 3) * dice.normal();
    gyro_C[r] += plan.gyro_offset_error_radps * counts_per_radps * dice.normal();
  }
  const Vector3d tip_m = plan.tip_in_marker_m + plan.tip_error_m * dice.normal3();
  const Vector3d place_m = plan.sensor_in_marker_m + plan.sensor_place_error_m * dice.normal3();
  const double scale = 1.0 + plan.force_scale_error * dice.normal();
  const double offset_N = sensors.force_offset_N + plan.force_offset_error_N * dice.normal() -
                          // Tared at the mean attitude: the weight of the tip is in the zero.
                          plan.tip_mass_kg * kGravity_mps2;
  Vector3d sigma_m = poses.rms_m, sigma_rad = poses.rms_rad;
  for (int axis = 0; axis < 3; ++axis) {
    sigma_m[axis] *= std::max(0.3, 1.0 + plan.sigma_error * dice.normal());
    sigma_rad[axis] *= std::max(0.3, 1.0 + plan.sigma_error * dice.normal());
  }
  const double latency_s = std::max(0.0, plan.latency_s + plan.latency_error_s * dice.normal());

  const double rounding_counts = std::sqrt(1.0 / 12.0);
  const double accel_sigma_counts =
      plan.accel_counts_per_g / kGravity_mps2 * plan.accel_noise_mps2_per_rtHz * std::sqrt(1.2 * plan.filter_Hz);
  Json out;
  out["format"] = "asperity-calibration";
  out["version"] = 1;
  out["accelerometer"] = {
      {"model", "linear"},
      {"B", rows_of(B)},
      {"C", list(C)},
      {"residual_counts", list(Vector3d::Constant(std::hypot(accel_sigma_counts, rounding_counts)))},
      {"stderr", rows_of(stderr_counts)},
      {"rotation_known", true},
      {"position_in_marker_m", list(place_m)}};
  if (plan.open) out["gyroscope"] = {{"B", rows_of(gyro_B)}, {"C", list(gyro_C)}};
  out["force"] = {{"newton_per_count", scale * sensors.force_newton_per_count},
                  {"offset_newton", offset_N},
                  {"residual_newton", plan.force_noise_N}};
  out["tip_in_marker_m"] = list(tip_m);
  out["tip_radius_m"] = plan.tip_radius_m;
  out["tracker"] = {{"sigma_position_m", list(sigma_m)},
                    {"sigma_rotation_rad", list(sigma_rad)},
                    {"latency_s", latency_s},
                    {"latency_sigma_s", plan.latency_error_s}};
  Json& extra = out["extra"];
  extra["accelerometer_position_sigma_m"] = plan.sensor_place_error_m;
  // As `asperity calibrate tip` and `force` state their errors.
  extra["calibrated"]["tip"]["stderr"]["tip_in_marker_m"] = list(Vector3d::Constant(plan.tip_error_m));
  extra["calibrated"]["force"]["stderr"] = {
      {"newton_per_count", plan.force_scale_error * sensors.force_newton_per_count},
      {"offset_newton", plan.force_offset_error_N}};
  return out;
}

Json recording_json(const ScanPlan& plan, const HandMotion& motion) {
  Dice dice(plan.seed, 62);
  const Vector3d turn_rad = plan.gravity_error_rad * dice.normal3();
  const Vector3d gravity = kGravity_world_mps2 + turn_rad.cross(kGravity_world_mps2);
  const std::int64_t end_ns = kStart_ns + std::llround(1e9 * static_cast<double>(motion.size()) * kStep_s);
  Json out;
  out["format"] = "asperity-recording";
  out["version"] = 1;
  out["created"] = "2000-01-01T00:00:00Z";
  out["object"] = plan.family;
  out["world"] = "camera";
  out["probe"] = {{"model", plan.open ? "open" : "what"},
                  {"nominal_rate_hz", plan.nominal_rate_Hz},
                  {"adc_min", plan.adc_min},
                  {"adc_max", plan.adc_max}};
  out["tracker"] = {{"nominal_rate_hz", plan.frame_rate_Hz}};
  out["gravity_world_mps2"] = list(gravity);
  out["segments"] = Json::array();
  out["segments"].push_back({{"name", plan.family}, {"start_ns", kStart_ns}, {"end_ns", end_ns}});
  out["problems"] = Json::object();
  out["extra"] = {{"second_bench", {{"seed", plan.seed}}}};
  return out;
}

}  // namespace

void write_scan(const ScanPlan& plan, const std::filesystem::path& folder) {
  const HandMotion motion = move_hand(plan);
  const TrueSensors sensors = draw_sensors(plan);
  const ProbeRows probe = sample_probe(plan, sensors, motion);
  const PoseRows poses = sample_tracker(plan, motion);
  std::filesystem::create_directories(folder);
  write(folder / "recording.json", recording_json(plan, motion).dump(1) + "\n");
  write(folder / "calibration.json", calibration_json(plan, sensors, poses).dump(1) + "\n");
  write(folder / "probe.csv", probe_csv(plan, probe));
  write(folder / "tracker.csv", tracker_csv(plan, poses));
  write(folder / "truth.csv", truth_csv(plan, probe, motion));
}

}  // namespace second_bench
