#include "pose_path.h"

#include <algorithm>
#include <cmath>

#include "asperity/signal/white_noise.h"

namespace asperity {

namespace {

double median_of_poses(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

Eigen::Vector3d white_noise_m(const PosePath& path) { return white_noise(path.t_s, path.p_world_tip_m); }

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
