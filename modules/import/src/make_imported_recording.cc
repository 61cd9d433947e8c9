#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include "asperity/base/config.h"
#include "asperity/base/error.h"
#include "asperity/base/units.h"
#include "asperity/import/import_mapped.h"
#include "asperity/json/config_json.h"
#include "pose_at.h"

namespace asperity {

namespace {

constexpr double kAdcSteps = 32768.0;

// The range, doubled until it holds the largest component.
double range_for(const std::vector<Eigen::Vector3d>& values, double range) {
  double most = 0.0;
  for (const auto& value : values) most = std::max(most, value.cwiseAbs().maxCoeff());
  constexpr double kMostDoublings = 40.0;
  for (double i = 0.0; i < kMostDoublings && most > range; i += 1.0) range *= 2.0;
  return range;
}

// Values at other times by straight lines; nan outside the stream and in gaps.
std::vector<Eigen::Vector3d> values_at(const VectorStream& stream, const std::vector<std::int64_t>& t_ns) {
  constexpr std::int64_t kGapIntervals = 10;
  const std::int64_t longest_ns = kGapIntervals * median_interval_ns(stream.t_ns);
  std::vector<Eigen::Vector3d> out;
  std::size_t row = 0;
  for (const std::int64_t t : t_ns) {
    while (row + 2 < stream.size() && stream.t_ns[row + 1] <= t) ++row;
    Eigen::Vector3d value = Eigen::Vector3d::Constant(std::nan(""));
    if (stream.size() >= 2 && t >= stream.t_ns[row] && t <= stream.t_ns[row + 1]) {
      const std::int64_t step = stream.t_ns[row + 1] - stream.t_ns[row];
      const double share = static_cast<double>(t - stream.t_ns[row]) / static_cast<double>(step);
      if (share == 0.0 || share == 1.0 || step <= longest_ns) {
        value = lerp(stream.value[row], stream.value[row + 1], share);
      }
    }
    out.push_back(value);
  }
  return out;
}

VectorStream on_times(const VectorStream& stream, const std::vector<std::int64_t>& t_ns) {
  return {t_ns, values_at(stream, t_ns)};
}

// All three axes of the force, or one of them in x.
VectorStream force_stream(const ImportStreams& streams) {
  VectorStream out = streams.force3;
  if (streams.force.size() > 0) {
    out.t_ns = streams.force.t_ns;
    out.value.clear();
    for (const double value : streams.force.value) out.value.emplace_back(value, 0.0, 0.0);
  }
  return out;
}

// The probe's rows are the force's where that is faster by more than half.
void use_faster_rows(const VectorStream& force, ImportStreams& streams) {
  if (force.size() < 2) return;
  const double force_ns = static_cast<double>(median_interval_ns(force.t_ns));
  const double imu_ns = static_cast<double>(median_interval_ns(streams.specific_force.t_ns));
  constexpr double kFaster = 1.5;
  if (imu_ns < kFaster * force_ns) return;
  const auto& imu_t = streams.specific_force.t_ns;
  std::vector<std::int64_t> t_ns;
  for (const std::int64_t t : force.t_ns) {
    if (t >= imu_t.front() && t <= imu_t.back()) t_ns.push_back(t);
  }
  if (t_ns.empty()) throw Error("the times of the force and of the inertial sensor do not overlap");
  // Rows in a gap of the sensor have no acceleration and are left out.
  VectorStream filled = on_times(streams.specific_force, t_ns);
  std::vector<std::int64_t> kept;
  for (std::size_t i = 0; i < t_ns.size(); ++i) {
    if (filled.value[i].allFinite()) kept.push_back(t_ns[i]);
  }
  if (kept.empty()) throw Error("the times of the force and of the inertial sensor do not overlap");
  streams.specific_force = on_times(streams.specific_force, kept);
  if (streams.rate.size() > 0) streams.rate = on_times(streams.rate, kept);
}

void add_force(const VectorStream& force, bool one_axis, Recording& recording) {
  constexpr double kRange_N = 16.0;
  const double newton_per_count = range_for(force.value, kRange_N) / kAdcSteps;
  const auto values = values_at(force, recording.probe.t_ns);
  recording.info.has_force_sensor = true;
  if (one_axis) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      recording.probe.force_counts[i] = std::round(values[i].x() / newton_per_count);
    }
    recording.calibration.force.newton_per_count = newton_per_count;
    return;
  }
  recording.probe.force3_counts.clear();
  for (std::size_t i = 0; i < values.size(); ++i) {
    recording.probe.force3_counts.push_back((values[i] / newton_per_count).array().round());
    recording.probe.force_counts[i] = std::round(values[i].norm() / newton_per_count);
  }
  recording.calibration.force.newton_per_count = newton_per_count;
  Force3Calibration calibration;
  calibration.B = Eigen::Matrix3d::Identity() / newton_per_count;
  recording.calibration.force3 = calibration;
}

Json file_origin(const ImportTable& table) {
  Json out;
  out["role"] = role_name(table.role);
  out["file"] = std::filesystem::path(table.table.file).filename().string();
  out["preset"] = table.preset.name;
  out["bytes"] = table.table.bytes;
  out["crc32"] = fmt::format("{:08x}", table.table.crc32);
  out["columns"] = columns_text(table.map, table.table);
  return out;
}

Json import_origin(const ImportedMotion& motion, const ImportTables& tables, MappingConfig mapping) {
  Json out;
  out["files"] = Json::array();
  for (const ImportTable* table : tables.all()) out["files"].push_back(file_origin(*table));
  out["mapping"] = config_json(list_fields("", mapping));
  out["up"] = motion.up;
  out["start_ns"] = motion.start_ns;
  if (motion.clocks) {
    const ClockFit& clocks = *motion.clocks;
    out["clocks"] = {
        {"by", clocks.by},       {"offset_s", clocks.offset_s},       {"offset_sigma_s", clocks.offset_sigma_s},
        {"drift", clocks.drift}, {"drift_sigma", clocks.drift_sigma}, {"correlation", clocks.correlation}};
  }
  return out;
}

ImportInput input_of(const ImportedMotion& motion, const ImportStreams& streams) {
  ImportInput out;
  out.imu_t_ns = streams.specific_force.t_ns;
  out.specific_force_mps2 = streams.specific_force.value;
  out.rate_radps = streams.rate.value;
  if (out.rate_radps.empty()) out.rate_radps.assign(out.imu_t_ns.size(), Eigen::Vector3d::Zero());
  out.pose_t_ns = streams.pose.t_ns;
  out.T_world_body = streams.pose.T_world_body;
  out.object_t_ns = motion.object.t_ns;
  out.T_world_object = motion.object.T_world_body;
  constexpr double kAccelerometerG = 16.0, kGyroscope_degps = 2000.0;
  out.accelerometer_range_mps2 = range_for(out.specific_force_mps2, kAccelerometerG * kStandardGravity_mps2);
  out.gyroscope_range_radps = range_for(out.rate_radps, kGyroscope_degps * std::numbers::pi / 180.0);
  out.problems = streams.problems;
  return out;
}

}  // namespace

TrackerSigma tracker_sigma(const PoseNoise& noise, const ImportConfig& config) {
  const auto choose = [](double stated, const Eigen::Vector3d& estimated, double least,
                         Eigen::Vector3d& sigma) -> std::string {
    if (stated > 0.0) {
      sigma.setConstant(stated);
      return "stated";
    }
    sigma = estimated.cwiseMax(least);
    return estimated.minCoeff() >= least  ? "estimated"
           : estimated.maxCoeff() < least ? "assumed"
                                          : "estimated, assumed";
  };
  TrackerSigma out;
  out.position_from = choose(config.tracker_sigma_m, noise.position_m, kAssumedPoseNoise_m, out.position_m);
  out.rotation_from = choose(config.tracker_sigma_rad, noise.rotation_rad, kAssumedPoseNoise_rad, out.rotation_rad);
  return out;
}

Recording make_imported_recording(const ImportedMotion& motion, const ImportTables& tables,
                                  const MappingConfig& mapping, const ImportConfig& config) {
  ImportStreams streams = motion.streams;
  const VectorStream force = force_stream(streams);
  use_faster_rows(force, streams);
  const TrackerSigma sigma = tracker_sigma(motion.noise, config);
  ImportInput input = input_of(motion, streams);
  input.sigma_position_m = sigma.position_m;
  input.sigma_rotation_rad = sigma.rotation_rad;
  Recording out = import_imu_pose(input, config);
  out.calibration.extra["tracker_sigma_from"] = {{"position", sigma.position_from}, {"rotation", sigma.rotation_from}};
  if (streams.rate.size() == 0) {
    out.probe.gyro_counts.clear();
    out.calibration.gyroscope.reset();
  }
  if (force.size() > 0) add_force(force, streams.force.size() > 0, out);
  const Eigen::Vector3d tip(mapping.tip_m[0], mapping.tip_m[1], mapping.tip_m[2]);
  out.calibration.tip_in_marker_m = tip;
  const auto is_zero = [](const std::array<double, 3>& x) { return x[0] == 0.0 && x[1] == 0.0 && x[2] == 0.0; };
  if (config.pose_rate_Hz == 0.0 && is_zero(config.pose_noise_m) && is_zero(config.rotation_noise_rad)) {
    out.truth.reset();  // the poses are the tracker's own: nothing better is known
  } else {
    for (std::size_t i = 0; i < out.truth->size(); ++i) {
      out.truth->p_world_tip_m[i] = streams.pose.T_world_body[i] * tip;
    }
  }
  if (motion.clocks) {
    constexpr double kOtherDelays_s = 5e-4;
    out.calibration.probe_latency_sigma_s = std::hypot(motion.clocks->offset_sigma_s, kOtherDelays_s);
  }
  out.info.extra["import_origin"] = import_origin(motion, tables, mapping);
  return out;
}

MappingConfig stated_mapping(const ImportTables& tables, const MappingConfig& config, const ImportedMotion& motion) {
  MappingConfig out = config;
  out.columns.clear();
  for (const ImportTable* table : tables.all()) {
    if (tables.object && table == &*tables.object) continue;  // read as the poses are
    FileMapping& file = mapping_of(out, table->role);
    file.columns = columns_text(table->map, table->table);
    file.preset = "none";
    if (table->rate_Hz > 0.0) file.rate_Hz = table->rate_Hz;
    if (file.section.empty()) file.section = preset_section(table->table.text, table->role);
  }
  if (out.euler.empty()) out.euler = tables.pose->preset.euler;
  if (!motion.up_is_assumed && !motion.up.starts_with('(')) out.up = motion.up;
  return out;
}

}  // namespace asperity
