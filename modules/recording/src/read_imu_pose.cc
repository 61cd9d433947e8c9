#include <cmath>

#include "asperity/base/csv.h"
#include "asperity/base/text.h"
#include "asperity/recording/import_imu_pose.h"
#include "csv_rows.h"
#include "pose_rows.h"

namespace asperity {

namespace {

// The row's time from its seconds, or nullopt with a problem.
std::optional<std::int64_t> row_seconds(const CsvReader& csv, std::size_t column, RowProblems& problems) {
  constexpr double kSecond_ns = 1e9;
  const double t_ns = number_or_nan(csv, column) * kSecond_ns;
  if (std::isnan(t_ns)) {
    problems.add("missing_time", csv.line(), "the row has no time and was left out");
    return std::nullopt;
  }
  if (std::abs(t_ns) > static_cast<double>(kLatestTime_ns)) {
    problems.add("time_far_off", csv.line(),
                 "the time is beyond a gap that is too long for one recording; such rows were left out");
    return std::nullopt;
  }
  return std::llround(t_ns);
}

}  // namespace

void parse_imu_csv(std::string_view text, const std::string& name, ImportInput& input, const ReadLimits& limits) {
  CsvReader csv(checked_lines(text, name), name);
  const std::size_t time = csv.require("t_s");
  const Columns3 force = require3(csv, "ax_mps2", "ay_mps2", "az_mps2");
  const Columns3 rate = require3(csv, "gx_radps", "gy_radps", "gz_radps");
  std::vector<std::uint32_t> line;
  RowProblems problems(name);
  while (csv.next()) {
    const auto t_ns = row_seconds(csv, time, problems);
    if (!t_ns) continue;
    const Eigen::Vector3d f = numbers3(csv, force);
    const Eigen::Vector3d omega = numbers3(csv, rate);
    if (!within(f, limits.largest_counts) || !within(omega, limits.largest_counts)) {
      problems.add("bad_sample", csv.line(), "a sample is not a valid reading; the row was left out");
      continue;
    }
    input.imu_t_ns.push_back(*t_ns);
    line.push_back(static_cast<std::uint32_t>(csv.line()));
    input.specific_force_mps2.push_back(f);
    input.rate_radps.push_back(omega);
  }
  finish_rows(csv, line, name, limits, problems, input.problems, input.imu_t_ns, input.specific_force_mps2,
              input.rate_radps);
}

namespace {

void parse_poses(std::string_view text, const std::string& name, const ReadLimits& limits, Problems& all_problems,
                 std::vector<std::int64_t>& t_ns_out, std::vector<Pose>& T_world_body) {
  CsvReader csv(checked_lines(text, name), name);
  const std::size_t time = csv.require("t_s");
  const PoseColumns columns(csv);
  std::vector<std::uint32_t> line;
  RowProblems problems(name);
  while (csv.next()) {
    const auto t_ns = row_seconds(csv, time, problems);
    if (!t_ns) continue;
    const auto pose = row_pose(csv, columns, limits, problems);
    if (!pose) continue;
    t_ns_out.push_back(*t_ns);
    line.push_back(static_cast<std::uint32_t>(csv.line()));
    T_world_body.push_back(*pose);
  }
  finish_rows(csv, line, name, limits, problems, all_problems, t_ns_out, T_world_body);
}

}  // namespace

void parse_pose_csv(std::string_view text, const std::string& name, ImportInput& input, const ReadLimits& limits) {
  parse_poses(text, name, limits, input.problems, input.pose_t_ns, input.T_world_body);
}

void parse_object_pose_csv(std::string_view text, const std::string& name, ImportInput& input,
                           const ReadLimits& limits) {
  parse_poses(text, name, limits, input.problems, input.object_t_ns, input.T_world_object);
}

ImportInput read_imu_pose(const std::filesystem::path& imu, const std::filesystem::path& poses,
                          const std::filesystem::path& object_poses, const ReadLimits& limits) {
  ImportInput out;
  parse_imu_csv(read_file(imu, limits.csv_bytes), imu.string(), out, limits);
  parse_pose_csv(read_file(poses, limits.csv_bytes), poses.string(), out, limits);
  if (!object_poses.empty())
    parse_object_pose_csv(read_file(object_poses, limits.csv_bytes), object_poses.string(), out, limits);
  return out;
}

}  // namespace asperity
