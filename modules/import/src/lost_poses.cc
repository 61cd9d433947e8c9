#include "lost_poses.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace asperity {

namespace {

constexpr const char* kKind = "lost_poses";

// The middle one; 0 if there is none.
double median_of(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// The gyroscope's integral, rad, at any time within its stream, by sums over its rows.
class Rotated {
 public:
  explicit Rotated(const VectorStream& rate) : t_ns_(rate.t_ns) {
    sum_.reserve(rate.size());
    for (std::size_t i = 0; i < rate.size(); ++i) {
      if (i == 0) {
        sum_.emplace_back(Eigen::Vector3d::Zero());
        continue;
      }
      const double step_s = 1e-9 * static_cast<double>(t_ns_[i] - t_ns_[i - 1]);
      sum_.emplace_back(sum_.back() + 0.5 * step_s * (rate.value[i] + rate.value[i - 1]));
    }
  }
  std::size_t row(std::int64_t t_ns) const {
    return static_cast<std::size_t>(std::lower_bound(t_ns_.begin(), t_ns_.end(), t_ns) - t_ns_.begin());
  }
  // Between the rows next to two times; nullopt: outside.
  std::optional<Eigen::Vector3d> between(std::int64_t from_ns, std::int64_t to_ns) const {
    const std::size_t from = row(from_ns), to = row(to_ns);
    if (to >= sum_.size()) return std::nullopt;
    return Eigen::Vector3d(sum_[to] - sum_[from]);
  }

 private:
  const std::vector<std::int64_t>& t_ns_;
  std::vector<Eigen::Vector3d> sum_;
};

bool is_same_pose(const Pose& a, const Pose& b) {
  return a.translation_m == b.translation_m && a.rotation.coeffs() == b.rotation.coeffs();
}

// The gyroscope's rate less the poses', the median over the steps between different poses.
Eigen::Vector3d rate_offset(const PoseStream& pose, const Rotated& rotated) {
  std::array<std::vector<double>, 3> differences;
  for (std::size_t i = 1; i < pose.size(); ++i) {
    if (is_same_pose(pose.T_world_body[i], pose.T_world_body[i - 1])) continue;
    const auto by_gyro = rotated.between(pose.t_ns[i - 1], pose.t_ns[i]);
    if (!by_gyro) continue;
    const Eigen::Vector3d by_pose =
        log_rotation(pose.T_world_body[i - 1].rotation.conjugate() * pose.T_world_body[i].rotation);
    const double step_s = 1e-9 * static_cast<double>(pose.t_ns[i] - pose.t_ns[i - 1]);
    for (int k = 0; k < 3; ++k)
      differences[static_cast<std::size_t>(k)].push_back(((*by_gyro)[k] - by_pose[k]) / step_s);
  }
  return {median_of(differences[0]), median_of(differences[1]), median_of(differences[2])};
}

double variation_mps2(const VectorStream& force, std::int64_t from_ns, std::int64_t to_ns) {
  const auto from = std::lower_bound(force.t_ns.begin(), force.t_ns.end(), from_ns) - force.t_ns.begin();
  const auto to = std::upper_bound(force.t_ns.begin(), force.t_ns.end(), to_ns) - force.t_ns.begin();
  if (to - from < 2) return 0.0;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (auto i = from; i < to; ++i) mean += force.value[static_cast<std::size_t>(i)] / static_cast<double>(to - from);
  double squares = 0.0;
  for (auto i = from; i < to; ++i) squares += (force.value[static_cast<std::size_t>(i)] - mean).squaredNorm();
  return std::sqrt(squares / static_cast<double>(to - from));
}

}  // namespace

std::size_t leave_out_zero_poses(const ImportTable& in, const std::array<std::vector<double>, 3>& position,
                                 std::vector<std::optional<Eigen::Quaterniond>>& rotation, Problems& problems) {
  const auto at = [&](std::size_t row) {
    return Eigen::Vector3d(position[0][row], position[1][row], position[2][row]);
  };
  const auto is_zero = [&](std::size_t row) {
    return rotation[row] && at(row) == Eigen::Vector3d::Zero() && rotation[row]->vec() == Eigen::Vector3d::Zero();
  };
  std::vector<double> steps;
  std::optional<std::size_t> last;
  for (std::size_t row = 0; row < rotation.size(); ++row) {
    if (!rotation[row] || is_zero(row) || !at(row).allFinite()) continue;
    if (last) steps.push_back((at(row) - at(*last)).norm());
    last = row;
  }
  constexpr double kLeast_m = 1e-3, kSteps = 10.0;
  const double far_m = std::max(kLeast_m, kSteps * median_of(std::move(steps)));
  std::size_t lost = 0;
  for (std::size_t row = 0; row < rotation.size(); ++row) {
    if (!is_zero(row)) continue;
    std::size_t end = row;
    while (end < rotation.size() && (is_zero(end) || !rotation[end])) ++end;
    const bool is_before_far = row == 0 || !at(row - 1).allFinite() || at(row - 1).norm() > far_m;
    const bool is_after_far = end == rotation.size() || !at(end).allFinite() || at(end).norm() > far_m;
    const bool are_all = row == 0 && end == rotation.size();
    for (; row < end; ++row) {
      if (are_all || !is_before_far || !is_after_far || !is_zero(row)) continue;
      rotation[row].reset();
      ++lost;
    }
  }
  if (lost == 0) return 0;
  problems.push_back(
      {kKind,
       fmt::format("{}: {} {} position 0 and no rotation, far from the poses next to them: the body was lost; "
                   "left out",
                   in.table.file, lost, lost == 1 ? "row has" : "rows have"),
       lost});
  return lost;
}

void leave_out_frozen_poses(const std::string& file, ImportStreams& streams) {
  PoseStream& pose = streams.pose;
  constexpr std::size_t kLeastRows = 3;
  constexpr double kRotated_rad = 0.02, kVaries_mps2 = 1.0;
  const Rotated rotated(streams.rate);
  std::optional<Eigen::Vector3d> offset_radps;
  std::vector<bool> is_lost(pose.size(), false);
  std::size_t lost = 0;
  for (std::size_t begin = 0; begin < pose.size();) {
    std::size_t end = begin + 1;
    while (end < pose.size() && is_same_pose(pose.T_world_body[end], pose.T_world_body[begin])) ++end;
    const std::int64_t from_ns = pose.t_ns[begin], to_ns = pose.t_ns[end - 1];
    bool moves = false;
    if (end - begin >= kLeastRows && streams.rate.size() > 1) {
      if (!offset_radps) offset_radps = rate_offset(pose, rotated);
      const auto by_gyro = rotated.between(from_ns, to_ns);
      // The offset is wrong where the axes are: the sensor must rotate with it and without.
      const double length_s = 1e-9 * static_cast<double>(to_ns - from_ns);
      moves = by_gyro && by_gyro->norm() > kRotated_rad && (*by_gyro - length_s * *offset_radps).norm() > kRotated_rad;
    } else if (end - begin >= kLeastRows) {
      moves = variation_mps2(streams.specific_force, from_ns, to_ns) > kVaries_mps2;
    }
    for (std::size_t i = begin + 1; moves && i < end; ++i) is_lost[i] = true, ++lost;
    begin = end;
  }
  if (lost == 0) return;
  PoseStream kept;
  for (std::size_t i = 0; i < pose.size(); ++i) {
    if (is_lost[i]) continue;
    kept.t_ns.push_back(pose.t_ns[i]);
    kept.T_world_body.push_back(pose.T_world_body[i]);
  }
  pose = std::move(kept);
  streams.problems.push_back(
      {kKind,
       fmt::format("{}: {} {} the pose before while the sensor moves: the body was lost; left out", file, lost,
                   lost == 1 ? "row repeats" : "rows repeat"),
       lost});
}

}  // namespace asperity
