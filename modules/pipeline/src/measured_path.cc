#include "asperity/pipeline/measured_path.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace asperity {

namespace {

double middle(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto half = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), half, values.end());
  return *half;
}

}  // namespace

PathPoints measured_path(const TipMotion& motion, std::span<const char> usable, const Eigen::Vector3d& tip_in_marker_m,
                         const MeasuredPathConfig& config) {
  PathPoints points;
  MeasuredPath& out = points.path;
  const bool axis_known = tip_in_marker_m.norm() > 0.0;
  Eigen::Vector3d first_m, sum_m = Eigen::Vector3d::Zero(), axis = Eigen::Vector3d::Zero();
  std::size_t count = 0, first = 0;
  std::vector<double> sigma_m;
  const auto close = [&] {
    if (count == 0) return;
    out.p_world_m.push_back(sum_m / static_cast<double>(count));
    points.sample.push_back(static_cast<double>(first) + 0.5 * static_cast<double>(count - 1));
    if (axis_known) out.outward_world.push_back(axis.normalized());
    out.q_world_marker.push_back(motion.q_world_marker[first + (count - 1) / 2]);
    sum_m.setZero();
    axis.setZero();
    count = 0;
  };
  for (std::size_t i = 0; i < motion.size(); ++i) {
    if (!usable.empty() && usable[i] == 0) {
      close();
      continue;
    }
    const Eigen::Vector3d& p_m = motion.p_world_tip_m[i];
    if (count > 0 && (p_m - first_m).norm() >= config.spacing_m) close();
    if (count == 0) {
      first_m = p_m;
      first = i;
    }
    sum_m += p_m;
    axis += motion.q_world_marker[i] * -tip_in_marker_m;
    ++count;
    if (!motion.cov_world_tip_m2.empty()) {
      // The tip's error in the marker is one error of all points: it moves the path and does not scatter it.
      const Eigen::Matrix3d R = motion.q_world_marker[i].toRotationMatrix();
      const Eigen::Matrix3d tip_m2 = R * motion.sigma_tip_in_marker_m.cwiseAbs2().asDiagonal() * R.transpose();
      const Eigen::Matrix3d of_point_m2 = motion.cov_world_tip_m2[i] - tip_m2;
      out.slow_covariance_world_m2 += of_point_m2;
      sigma_m.push_back(std::sqrt(std::max(0.0, of_point_m2.trace() / 3.0)));
    }
  }
  close();
  if (!sigma_m.empty()) out.slow_covariance_world_m2 /= static_cast<double>(sigma_m.size());
  out.sigma_m = middle(std::move(sigma_m));
  out.tip_sigma_m = motion.sigma_tip_in_marker_m;
  return points;
}

MeasuredPath smooth_path(const MeasuredPath& path, double length_m) {
  const std::size_t n = path.p_world_m.size();
  std::vector<double> steps_m;
  for (std::size_t i = 1; i < n; ++i) steps_m.push_back((path.p_world_m[i] - path.p_world_m[i - 1]).norm());
  const double spacing_m = middle(steps_m);
  MeasuredPath out = path;
  const double reach = spacing_m > 0.0 ? std::floor(0.5 * length_m / spacing_m) : 0.0;
  const auto most = static_cast<std::size_t>(std::min(reach, static_cast<double>(n)));
  std::size_t begin = 0;  // of the unbroken stretch
  while (begin < n) {
    std::size_t end = begin + 1;
    while (end < n && steps_m[end - 1] <= 3.0 * spacing_m) ++end;
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t half = std::min({most, i - begin, end - 1 - i});
      Eigen::Vector3d sum_m = Eigen::Vector3d::Zero();
      for (std::size_t k = i - half; k <= i + half; ++k) sum_m += path.p_world_m[k];
      out.p_world_m[i] = sum_m / static_cast<double>(2 * half + 1);
    }
    begin = end;
  }
  return out;
}

}  // namespace asperity
