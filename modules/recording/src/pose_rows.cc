#include "pose_rows.h"

#include "quaternion_check.h"

namespace asperity {

PoseColumns::PoseColumns(const CsvReader& csv, const std::string& prefix)
    : position{csv.require(prefix + "px_m"), csv.require(prefix + "py_m"), csv.require(prefix + "pz_m")},
      rotation{csv.require(prefix + "qw"), csv.require(prefix + "qx"), csv.require(prefix + "qy"),
               csv.require(prefix + "qz")} {}

std::optional<Pose> row_pose(const CsvReader& csv, const PoseColumns& columns, const ReadLimits& limits,
                             RowProblems& problems) {
  Pose pose;
  pose.translation_m = numbers3(csv, columns.position);
  std::array<double, 4> q{};
  for (std::size_t i = 0; i < 4; ++i) q[i] = number_or_nan(csv, columns.rotation[i]);
  pose.rotation = Eigen::Quaterniond(q[0], q[1], q[2], q[3]);
  if (!pose.translation_m.allFinite() || !pose.rotation.coeffs().allFinite()) {
    problems.add("missing_pose", csv.line(), "the pose is not a number; the row was left out");
    return std::nullopt;
  }
  if (!within(pose.translation_m, limits.largest_position_m)) {
    problems.add("position_far_off", csv.line(), "the position is too far away to be one; the row was left out");
    return std::nullopt;
  }
  switch (make_unit(pose.rotation)) {
    case QuaternionState::kUnit:
      return pose;
    case QuaternionState::kRepaired:
      problems.add("quaternion_length", csv.line(), "the quaternion was not of length one and was normalised");
      return pose;
    case QuaternionState::kUnusable:
      break;
  }
  problems.add("bad_quaternion", csv.line(), "the quaternion is not a rotation; the row was left out");
  return std::nullopt;
}

}  // namespace asperity
