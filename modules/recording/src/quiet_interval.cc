#include "quiet_interval.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "asperity/base/nan.h"
#include "asperity/base/units.h"

namespace asperity {

namespace {

struct Moments {
  Eigen::Vector3d mean = Eigen::Vector3d::Constant(kNan);
  Eigen::Vector3d deviation = Eigen::Vector3d::Constant(kNan);
};

Moments moments(const std::vector<Eigen::Vector3d>& values) {
  Moments out;
  if (values.empty()) return out;
  const auto count = static_cast<double>(values.size());
  out.mean.setZero();
  for (const auto& value : values) out.mean += value / count;
  Eigen::Vector3d square = Eigen::Vector3d::Zero();
  for (const auto& value : values) square += (value - out.mean).cwiseAbs2();
  if (values.size() > 1) out.deviation = (square / (count - 1.0)).cwiseSqrt();
  return out;
}

// Deviation of one value from differences of neighbours, which a slow drift of the hand does not reach.
Eigen::Vector3d noise_of_steps(const std::vector<Eigen::Vector3d>& steps) {
  Eigen::Vector3d square = Eigen::Vector3d::Zero();
  for (const auto& step : steps) square += step.cwiseAbs2();
  return (square / (2.0 * static_cast<double>(steps.size()))).cwiseSqrt();
}

std::vector<Pose> poses_between(const Recording& recording, std::int64_t first_ns, std::int64_t last_ns) {
  const auto latency_ns =
      static_cast<std::int64_t>(std::llround(recording.calibration.tracker.latency_s / kNanosecond_s));
  const auto& t_ns = recording.tracker.t_ns;
  const auto begin = std::lower_bound(t_ns.begin(), t_ns.end(), first_ns + latency_ns);
  const auto end = std::upper_bound(begin, t_ns.end(), last_ns + latency_ns);
  const auto& poses = recording.tracker.T_world_marker;
  return {poses.begin() + (begin - t_ns.begin()), poses.begin() + (end - t_ns.begin())};
}

// From up to the specific force, which points up at rest.
double angle_to_up_rad(const Recording& recording, const Eigen::Vector3d& f_marker_mps2,
                       const std::vector<Pose>& poses) {
  if (poses.empty() || !recording.calibration.accelerometer.rotation_known) return kNan;
  Eigen::Vector3d f_world_mps2 = Eigen::Vector3d::Zero();
  for (const auto& pose : poses) f_world_mps2 += pose.rotation * f_marker_mps2;
  const Eigen::Vector3d up = -recording.info.gravity_world_mps2;
  return std::atan2(f_world_mps2.cross(up).norm(), f_world_mps2.dot(up));
}

}  // namespace

std::optional<RowRange> find_quiet_interval(const ProbeStream& probe, const StreamTiming& timing,
                                            const InspectConfig& config) {
  constexpr std::size_t kFewest = 20;
  if (probe.size() < kFewest || !(config.quiet_s <= timing.duration_s)) return std::nullopt;
  const double rows_wanted = std::max(config.quiet_s / timing.period_s, static_cast<double>(kFewest));
  if (rows_wanted > static_cast<double>(probe.size())) return std::nullopt;
  const auto rows = static_cast<std::size_t>(rows_wanted);
  // Rows that come late stretch the window; a tenth more is still without a loss worth the name.
  const auto longest_ns = static_cast<std::int64_t>(1.1 * config.quiet_s / kNanosecond_s) + 1;

  // Sums about the overall mean keep their digits over long recordings.
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const auto& counts : probe.accel_counts) mean += counts / static_cast<double>(probe.size());
  std::vector<Eigen::Vector3d> sum(probe.size() + 1, Eigen::Vector3d::Zero());
  std::vector<double> square(probe.size() + 1, 0.0);
  for (std::size_t i = 0; i < probe.size(); ++i) {
    const Eigen::Vector3d counts = probe.accel_counts[i] - mean;
    sum[i + 1] = sum[i] + counts;
    square[i + 1] = square[i] + counts.squaredNorm();
  }
  std::optional<RowRange> best;
  double least = std::numeric_limits<double>::infinity();
  const std::size_t step = std::max<std::size_t>(rows / 20, 1);
  for (std::size_t first = 0; first + rows <= probe.size(); first += step) {
    const std::size_t last = first + rows;
    if (probe.t_ns[last - 1] - probe.t_ns[first] > longest_ns) continue;
    const double variation =
        square[last] - square[first] - (sum[last] - sum[first]).squaredNorm() / static_cast<double>(rows);
    if (variation < least) {
      least = variation;
      best = RowRange{first, last};
    }
  }
  return best;
}

QuietInterval describe_quiet_interval(const Recording& recording, const RowRange& rows, const InspectConfig& config) {
  const ProbeStream& probe = recording.probe;
  QuietInterval out;
  out.start_s = static_cast<double>(probe.t_ns[rows.first] - probe.t_ns.front()) * kNanosecond_s;
  out.duration_s = static_cast<double>(probe.t_ns[rows.last - 1] - probe.t_ns[rows.first]) * kNanosecond_s;

  std::vector<Eigen::Vector3d> f_marker_mps2;
  f_marker_mps2.reserve(rows.last - rows.first);
  double force_sum_N = 0.0;
  std::size_t force_count = 0;
  for (std::size_t i = rows.first; i < rows.last; ++i) {
    f_marker_mps2.push_back(recording.calibration.accelerometer.specific_force_mps2(probe.accel_counts[i]));
    if (std::isnan(probe.force_counts[i])) continue;
    force_sum_N += recording.calibration.force.force_N(probe.force_counts[i]);
    ++force_count;
  }
  const Moments acceleration = moments(f_marker_mps2);
  out.specific_force_mps2 = acceleration.mean;
  out.acceleration_noise_mps2 = acceleration.deviation;
  out.gravity_mps2 = acceleration.mean.norm();
  if (force_count > 0) out.force_N = force_sum_N / static_cast<double>(force_count);

  const std::vector<Pose> poses = poses_between(recording, probe.t_ns[rows.first], probe.t_ns[rows.last - 1]);
  out.poses = poses.size();
  out.gravity_angle_rad = angle_to_up_rad(recording, acceleration.mean, poses);
  bool still = acceleration.deviation.maxCoeff() <= config.rest_acceleration_mps2;
  constexpr std::size_t kFewestPoses = 5;
  if (poses.size() >= kFewestPoses) {
    std::vector<Eigen::Vector3d> positions_m;
    std::vector<Eigen::Vector3d> steps_m;
    std::vector<Eigen::Vector3d> turns_rad;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      positions_m.push_back(poses[i].translation_m);
      if (i == 0) continue;
      steps_m.push_back(poses[i].translation_m - poses[i - 1].translation_m);
      turns_rad.push_back(log_rotation(poses[i].rotation * poses[i - 1].rotation.conjugate()));
    }
    out.position_noise_m = noise_of_steps(steps_m);
    out.rotation_noise_rad = noise_of_steps(turns_rad);
    const Eigen::Vector3d allowed_m = 3.0 * recording.calibration.tracker.sigma_position_m;
    still = still && (moments(positions_m).deviation.array() <= allowed_m.array().max(config.rest_position_m)).all();
  }
  out.at_rest = still;
  return out;
}

}  // namespace asperity
