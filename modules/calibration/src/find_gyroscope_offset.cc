#include "asperity/calibration/find_gyroscope_offset.h"

#include <cmath>

#include "asperity/base/units.h"

namespace asperity {

std::optional<GyroscopeOffset> find_gyroscope_offset(const Recording& recording, const std::vector<StaticPose>& poses) {
  const ProbeStream& probe = recording.probe;
  if (!probe.has_gyro()) return std::nullopt;
  std::vector<Eigen::Vector3d> means;
  std::size_t row = 0;
  const auto time_s = [&](std::size_t i) {
    return static_cast<double>(probe.t_ns[i] - probe.t_ns.front()) * kNanosecond_s;
  };
  for (const StaticPose& pose : poses) {
    while (row < probe.size() && time_s(row) < pose.start_s) ++row;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    std::size_t rows = 0;
    for (; row < probe.size() && time_s(row) <= pose.start_s + pose.duration_s; ++row) {
      if (!probe.gyro_counts[row].allFinite()) continue;
      sum += probe.gyro_counts[row];
      ++rows;
    }
    if (rows > 0) means.emplace_back(sum / static_cast<double>(rows));
  }
  if (means.size() < 3) return std::nullopt;
  GyroscopeOffset out;
  out.poses = means.size();
  const auto n = static_cast<double>(means.size());
  for (const Eigen::Vector3d& mean : means) out.counts += mean / n;
  Eigen::Vector3d square = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& mean : means) square += (mean - out.counts).cwiseAbs2();
  out.scatter_counts = (square / (n - 1.0)).cwiseSqrt();
  out.stderr_counts = out.scatter_counts / std::sqrt(n);
  return out;
}

}  // namespace asperity
