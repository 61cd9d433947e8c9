#include "pose_path.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace asperity {

namespace {

double median_of_poses(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

Eigen::Vector3d white_noise_m(const PosePath& path) {
  constexpr std::size_t kWindow = 32;
  constexpr double kGain2 = 70.0;  // 1² + 4² + 6² + 4² + 1²
  std::vector<double> steps_s;
  for (std::size_t i = 1; i < path.t_s.size(); ++i) steps_s.push_back(path.t_s[i] - path.t_s[i - 1]);
  const auto middle = steps_s.begin() + static_cast<std::ptrdiff_t>(steps_s.size() / 2);
  std::nth_element(steps_s.begin(), middle, steps_s.end());
  const double longest_s = 1.5 * *middle;
  std::array<std::vector<double>, 3> levels;
  Eigen::Array3d sum = Eigen::Array3d::Zero();
  std::size_t count = 0;
  for (std::size_t i = 2; i + 2 < path.t_s.size(); ++i) {
    if (path.t_s[i + 2] - path.t_s[i - 2] > 4.0 * longest_s) continue;
    const auto& p = path.p_world_tip_m;
    const Eigen::Vector3d fourth_m = p[i - 2] - 4.0 * p[i - 1] + 6.0 * p[i] - 4.0 * p[i + 1] + p[i + 2];
    sum += fourth_m.array().square() / kGain2;
    if (++count < kWindow) continue;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      levels[axis].push_back(std::sqrt(sum[static_cast<Eigen::Index>(axis)] / static_cast<double>(count)));
    }
    sum.setZero();
    count = 0;
  }
  Eigen::Vector3d out = Eigen::Vector3d::Zero();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (levels[axis].empty()) continue;
    const auto usual = levels[axis].begin() + static_cast<std::ptrdiff_t>(levels[axis].size() / 2);
    std::nth_element(levels[axis].begin(), usual, levels[axis].end());
    out[static_cast<Eigen::Index>(axis)] = *usual;
  }
  return out;
}

std::vector<char> find_outlying_poses(const PosePath& path, const Eigen::Vector3d& sigma_m) {
  constexpr double kReach_s = 0.15;
  constexpr double kOutlying = 6.0;  // standard deviations of the poses, or of what the neighbours spread over
  std::vector<char> out(path.t_s.size(), 0);
  std::size_t first = 0, last = 0;
  std::vector<double> values, distances;
  for (std::size_t i = 0; i < path.t_s.size(); ++i) {
    while (path.t_s[i] - path.t_s[first] > kReach_s) ++first;
    while (last < path.t_s.size() && path.t_s[last] - path.t_s[i] <= kReach_s) ++last;
    bool outlying = false;
    for (int axis = 0; axis < 3; ++axis) {
      values.clear();
      distances.clear();
      for (std::size_t j = first; j < last; ++j) values.push_back(path.p_world_tip_m[j][axis]);
      const double middle_m = median_of_poses(values);
      for (const double value : values) distances.push_back(std::abs(value - middle_m));
      const double spread_m = std::max(sigma_m[axis], 1.48 * median_of_poses(distances));
      outlying |= std::abs(path.p_world_tip_m[i][axis] - middle_m) > kOutlying * spread_m;
    }
    out[i] = outlying ? 1 : 0;
  }
  return out;
}

PosePath without_outliers(const PosePath& path, const Eigen::Vector3d& sigma_m) {
  const std::vector<char> outlying = find_outlying_poses(path, sigma_m);
  PosePath out;
  for (std::size_t i = 0; i < path.t_s.size(); ++i) {
    if (outlying[i] != 0) continue;
    out.t_s.push_back(path.t_s[i]);
    out.p_world_tip_m.push_back(path.p_world_tip_m[i]);
  }
  return out;
}

}  // namespace asperity
