#include <cmath>
#include <optional>

#include "asperity/base/nan.h"
#include "asperity/recording/parse_recording.h"
#include "csv_rows.h"
#include "pose_rows.h"

namespace asperity {

namespace {

// A sensor slower than the rows may have no sample here, but not half of one.
Eigen::Vector3d slow_sample(const CsvReader& csv, const Columns3& columns, double limit, RowProblems& problems) {
  Eigen::Vector3d sample = numbers3(csv, columns);
  if (sample.array().isNaN().all() || within(sample, limit)) return sample;
  problems.add("bad_sample", csv.line(), "a sample is not a valid reading; it counts as missing");
  return Eigen::Vector3d::Constant(kNan);
}

double slow_sample(const CsvReader& csv, std::size_t column, double limit, RowProblems& problems) {
  const double sample = number_or_nan(csv, column);
  if (std::isnan(sample) || std::abs(sample) <= limit) return sample;
  problems.add("bad_sample", csv.line(), "a sample is not a valid reading; it counts as missing");
  return kNan;
}

// Rows between the samples of an accelerometer slower than the rows lie on straight lines, so that the other
// sensors' samples in them keep their place; before the first and after the last they hold.
void fill_slow_accelerometer(const std::string& name, ProbeStream& probe, Problems& problems) {
  const std::size_t n = probe.size();
  std::size_t previous = n;
  std::size_t filled = 0;
  for (std::size_t i = 0; i < n; ++i) {
    if (!probe.accel_counts[i].allFinite()) continue;
    for (std::size_t j = previous == n ? 0 : previous + 1; j < i; ++j, ++filled) {
      if (previous == n) {
        probe.accel_counts[j] = probe.accel_counts[i];
        continue;
      }
      const double share = static_cast<double>(probe.t_ns[j] - probe.t_ns[previous]) /
                           static_cast<double>(probe.t_ns[i] - probe.t_ns[previous]);
      probe.accel_counts[j] =
          probe.accel_counts[previous] + share * (probe.accel_counts[i] - probe.accel_counts[previous]);
    }
    previous = i;
  }
  if (previous == n) throw Error(name + ": no row has an acceleration");
  for (std::size_t j = previous + 1; j < n; ++j, ++filled) probe.accel_counts[j] = probe.accel_counts[previous];
  if (filled > 0) {
    problems.push_back(
        {"slow_accelerometer", name + ": rows without an acceleration were filled between those with one", filled});
  }
}

}  // namespace

ProbeStream parse_probe_csv(std::string_view text, const std::string& name, Problems& problems,
                            const ReadLimits& limits) {
  CsvReader csv(checked_lines(text, name), name);
  const std::size_t time = csv.require("t_ns");
  const Columns3 accel = require3(csv, "accel_i", "accel_j", "accel_k");
  const std::size_t force = csv.require("force");
  const auto gyro = find3(csv, "gyro_i", "gyro_j", "gyro_k");
  const auto force3 = find3(csv, "force_x", "force_y", "force_z");

  ProbeStream out;
  std::vector<std::uint32_t> line;
  const std::size_t rows = most_rows(text, csv.columns().size());
  out.t_ns.reserve(rows);
  out.accel_counts.reserve(rows);
  out.force_counts.reserve(rows);
  if (gyro) out.gyro_counts.reserve(rows);
  if (force3) out.force3_counts.reserve(rows);
  line.reserve(rows);

  RowProblems row_problems(name);
  while (csv.next()) {
    const auto t_ns = row_time(csv, time, row_problems);
    if (!t_ns) continue;
    const Eigen::Vector3d sample = numbers3(csv, accel);
    const bool none = csv.empty(accel[0]) && csv.empty(accel[1]) && csv.empty(accel[2]);
    if (!none && !within(sample, limits.largest_counts)) {
      row_problems.add("bad_acceleration", csv.line(), "the acceleration is not a valid reading; the row was left out");
      continue;
    }
    out.t_ns.push_back(*t_ns);
    line.push_back(static_cast<std::uint32_t>(csv.line()));
    out.accel_counts.push_back(sample);
    out.force_counts.push_back(slow_sample(csv, force, limits.largest_counts, row_problems));
    if (gyro) out.gyro_counts.push_back(slow_sample(csv, *gyro, limits.largest_counts, row_problems));
    if (force3) out.force3_counts.push_back(slow_sample(csv, *force3, limits.largest_counts, row_problems));
  }
  finish_rows(csv, line, name, limits, row_problems, problems, out.t_ns, out.accel_counts, out.force_counts,
              out.gyro_counts, out.force3_counts);
  fill_slow_accelerometer(name, out, problems);
  return out;
}

TrackerStream parse_tracker_csv(std::string_view text, const std::string& name, Problems& problems,
                                const ReadLimits& limits) {
  CsvReader csv(checked_lines(text, name), name);
  const std::size_t time = csv.require("t_ns");
  const PoseColumns columns(csv);
  const auto markers = csv.find("markers");
  const auto reprojection = csv.find("reprojection_px");
  const auto sigma_position = find3(csv, "sigma_px_m", "sigma_py_m", "sigma_pz_m");
  const auto sigma_rotation = find3(csv, "sigma_rx_rad", "sigma_ry_rad", "sigma_rz_rad");
  const auto noise_position = find3(csv, "noise_px_m", "noise_py_m", "noise_pz_m");
  const auto noise_rotation = find3(csv, "noise_rx_rad", "noise_ry_rad", "noise_rz_rad");
  const auto sigma3 = [&](const Columns3& at) -> Eigen::Vector3d {
    return {number_or_nan(csv, at[0]), number_or_nan(csv, at[1]), number_or_nan(csv, at[2])};
  };

  TrackerStream out;
  std::vector<std::uint32_t> line;
  RowProblems row_problems(name);
  while (csv.next()) {
    const auto t_ns = row_time(csv, time, row_problems);
    if (!t_ns) continue;
    const auto pose = row_pose(csv, columns, limits, row_problems);
    if (!pose) continue;
    if (markers) {
      const std::int64_t seen = csv.empty(*markers) ? 0 : csv.integer(*markers);
      if (seen < 0 || seen > 1'000'000) csv.fail(*markers, "is not a number of markers");
      out.markers.push_back(static_cast<int>(seen));
    }
    if (reprojection) out.reprojection_px.push_back(number_or_nan(csv, *reprojection));
    if (sigma_position) out.sigma_position_m.push_back(sigma3(*sigma_position));
    if (sigma_rotation) out.sigma_rotation_rad.push_back(sigma3(*sigma_rotation));
    if (noise_position) out.noise_position_m.push_back(sigma3(*noise_position));
    if (noise_rotation) out.noise_rotation_rad.push_back(sigma3(*noise_rotation));
    out.t_ns.push_back(*t_ns);
    line.push_back(static_cast<std::uint32_t>(csv.line()));
    out.T_world_marker.push_back(*pose);
  }
  finish_rows(csv, line, name, limits, row_problems, problems, out.t_ns, out.T_world_marker, out.markers,
              out.reprojection_px, out.sigma_position_m, out.sigma_rotation_rad, out.noise_position_m,
              out.noise_rotation_rad);
  return out;
}

TrackerStream parse_body_csv(std::string_view text, const std::string& name, Problems& problems,
                             const ReadLimits& limits) {
  CsvReader csv(checked_lines(text, name), name);
  if (csv.next()) return parse_tracker_csv(text, name, problems, limits);
  csv.require("t_ns");
  static_cast<void>(PoseColumns(csv));
  problems.push_back({"body_unseen", name + ": no pose: the body was never seen", 1});
  return {};
}

Truth parse_truth_csv(std::string_view text, const std::string& name, Problems& problems, const ReadLimits& limits) {
  CsvReader csv(checked_lines(text, name), name);
  const std::size_t time = csv.require("t_ns");
  const std::size_t s = csv.require("s_m");
  const std::size_t height = csv.require("height_m");
  const PoseColumns columns(csv);
  const std::size_t force = csv.require("force_N");
  std::optional<PoseColumns> object;
  if (csv.find("object_px_m")) object.emplace(csv, "object_");

  Truth out;
  std::vector<std::uint32_t> line;
  RowProblems row_problems(name);
  while (csv.next()) {
    const auto t_ns = row_time(csv, time, row_problems);
    if (!t_ns) continue;
    const auto pose = row_pose(csv, columns, limits, row_problems);
    if (!pose) continue;
    if (object) {
      const auto object_pose = row_pose(csv, *object, limits, row_problems);
      if (!object_pose) continue;
      out.T_world_object.push_back(*object_pose);
    }
    out.t_ns.push_back(*t_ns);
    line.push_back(static_cast<std::uint32_t>(csv.line()));
    out.s_m.push_back(slow_sample(csv, s, limits.largest_position_m, row_problems));
    out.height_m.push_back(slow_sample(csv, height, limits.largest_position_m, row_problems));
    out.p_world_tip_m.push_back(pose->translation_m);
    out.q_world_marker.push_back(pose->rotation);
    out.force_N.push_back(slow_sample(csv, force, limits.largest_counts, row_problems));
  }
  finish_rows(csv, line, name, limits, row_problems, problems, out.t_ns, out.s_m, out.height_m, out.p_world_tip_m,
              out.q_world_marker, out.force_N, out.T_world_object);
  return out;
}

}  // namespace asperity
