#include "asperity/pipeline/compare_specific_force.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/base/units.h"
#include "motion_windows.h"

namespace asperity {

namespace {

constexpr double kWindow_s = 1.0;
constexpr double kHop_s = 0.5;
constexpr double kLongestGap_s = 0.15;
constexpr std::size_t kFewestPoses = 8;
constexpr double kLargestRotation_rad = 0.5;  // of a sensor whose rotation to the marker is not known

// sin⁴(πu): its first and second derivatives vanish at 0 and 1 as well.
double window_weight(double u) { return std::pow(std::sin(std::numbers::pi * u), 4); }

// The second derivative of window_weight() by u.
double window_weight_second(double u) {
  const double s = std::sin(std::numbers::pi * u);
  const double c = std::cos(std::numbers::pi * u);
  return std::numbers::pi * std::numbers::pi * (12.0 * s * s * c * c - 4.0 * s * s * s * s);
}

bool is_at_limit(const Eigen::Vector3d& counts, const RecordingInfo& info) {
  return info.adc_max > info.adc_min &&
         ((counts.array() <= info.adc_min).any() || (counts.array() >= info.adc_max).any());
}

double median_over_windows(std::vector<double> values) {
  if (values.empty()) return SpecificForceComparison::kUnknown;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::vector<double> times_from_s(const std::vector<std::int64_t>& t_ns, std::int64_t origin_ns, double latency_s) {
  std::vector<double> out;
  out.reserve(t_ns.size());
  for (const std::int64_t t : t_ns) out.push_back(static_cast<double>(t - origin_ns) * kNanosecond_s - latency_s);
  return out;
}

// The poses in a window, as indices [first, last); nullopt if some are missing.
struct PoseRange {
  std::size_t first = 0;
  std::size_t last = 0;
};

std::optional<PoseRange> poses_between(const std::vector<double>& t_s, double start_s, double end_s) {
  const auto lower = std::lower_bound(t_s.begin(), t_s.end(), start_s);
  const auto upper = std::upper_bound(lower, t_s.end(), end_s);
  PoseRange range{static_cast<std::size_t>(lower - t_s.begin()), static_cast<std::size_t>(upper - t_s.begin())};
  if (range.last - range.first < kFewestPoses) return std::nullopt;
  double before_s = start_s;
  for (std::size_t i = range.first; i < range.last; ++i) {
    if (t_s[i] - before_s > kLongestGap_s) return std::nullopt;
    before_s = t_s[i];
  }
  if (end_s - before_s > kLongestGap_s) return std::nullopt;
  return range;
}

// ∫ẅ p dt / ∫w dt by the trapezoidal rule, the straight line through the window's ends taken off, which adds nothing.
Eigen::Vector3d weighted_acceleration(const std::vector<double>& t_s, const std::vector<Eigen::Vector3d>& p_m,
                                      const PoseRange& range, double start_s, double length_s) {
  const Eigen::Vector3d first_m = p_m[range.first], last_m = p_m[range.last - 1];
  const double first_s = t_s[range.first], span_s = t_s[range.last - 1] - first_s;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double weights = 0.0;
  for (std::size_t i = range.first; i < range.last; ++i) {
    const double before_s = i == range.first ? start_s : t_s[i - 1];
    const double after_s = i + 1 == range.last ? start_s + length_s : t_s[i + 1];
    const double width_s = 0.5 * (after_s - before_s);
    const double u = (t_s[i] - start_s) / length_s;
    const double line = span_s > 0.0 ? (t_s[i] - first_s) / span_s : 0.0;
    sum += width_s * window_weight_second(u) / (length_s * length_s) * (p_m[i] - first_m - line * (last_m - first_m));
    weights += width_s * window_weight(u);
  }
  return sum / weights;
}

// The mean orientation under the weight, and its second derivative.
void add_rotation(const std::vector<double>& t_s, const TrackerStream& tracker, const PoseRange& range, double start_s,
                  double length_s, MotionWindow& out) {
  std::vector<Eigen::Vector3d> column(t_s.size(), Eigen::Vector3d::Zero());
  for (int k = 0; k < 3; ++k) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double weights = 0.0;
    for (std::size_t i = range.first; i < range.last; ++i) {
      column[i] = tracker.T_world_marker[i].rotation * Eigen::Vector3d::Unit(k);
      const double w = window_weight((t_s[i] - start_s) / length_s);
      sum += w * column[i];
      weights += w;
    }
    out.rotation.col(k) = sum / weights;
    out.rotation_per_s2.col(k) = weighted_acceleration(t_s, column, range, start_s, length_s);
  }
}

struct WindowForce {
  Eigen::Vector3d mean_mps2 = Eigen::Vector3d::Zero();
  std::size_t samples = 0;
  std::size_t clipped = 0;
};

struct ForceStreams {
  const Recording& recording;
  std::vector<double> pose_s, sample_s;
  std::vector<Eigen::Vector3d> p_world_accelerometer_m;
};

// The weighted mean specific force, in the world; of a sensor with an unknown rotation, in its own frame.
WindowForce weighted_force(const ForceStreams& streams, const PoseRange& poses, double start_s, double length_s) {
  const Recording& recording = streams.recording;
  const AccelerometerCalibration& accelerometer = recording.calibration.accelerometer;
  WindowForce out;
  double weights = 0.0;
  std::size_t after = poses.first;
  auto i = static_cast<std::size_t>(std::lower_bound(streams.sample_s.begin(), streams.sample_s.end(), start_s) -
                                    streams.sample_s.begin());
  for (; i < streams.sample_s.size() && streams.sample_s[i] < start_s + length_s; ++i) {
    const double t_s = streams.sample_s[i];
    const double w = window_weight((t_s - start_s) / length_s);
    const Eigen::Vector3d& counts = recording.probe.accel_counts[i];
    Eigen::Vector3d force_mps2 = accelerometer.specific_force_mps2(counts);
    if (accelerometer.rotation_known) {
      while (after + 1 < poses.last && streams.pose_s[after] < t_s) ++after;
      const std::size_t before = after == poses.first ? after : after - 1;
      const double width_s = streams.pose_s[after] - streams.pose_s[before];
      const double share = width_s > 0.0 ? std::clamp((t_s - streams.pose_s[before]) / width_s, 0.0, 1.0) : 0.0;
      force_mps2 = slerp(recording.tracker.T_world_marker[before].rotation,
                         recording.tracker.T_world_marker[after].rotation, share) *
                   force_mps2;
    }
    out.mean_mps2 += w * force_mps2;
    weights += w;
    ++out.samples;
    out.clipped += is_at_limit(counts, recording.info) ? 1 : 0;
  }
  if (weights > 0.0) out.mean_mps2 /= weights;
  return out;
}

bool turns_much(const TrackerStream& tracker, const PoseRange& range) {
  for (std::size_t i = range.first; i < range.last; ++i) {
    if (rotation_between_rad(tracker.T_world_marker[range.first], tracker.T_world_marker[i]) > kLargestRotation_rad)
      return true;
  }
  return false;
}

}  // namespace

SpecificForceComparison compare_specific_force(const Recording& recording, double tracker_latency_s,
                                               double probe_latency_s) {
  SpecificForceComparison out;
  const ProbeStream& probe = recording.probe;
  const TrackerStream& tracker = recording.tracker;
  if (probe.size() < 2 || tracker.size() < kFewestPoses) return out;
  for (const Eigen::Vector3d& counts : probe.accel_counts)
    out.clipped_share += is_at_limit(counts, recording.info) ? 1.0 / static_cast<double>(probe.size()) : 0.0;

  ForceStreams streams{recording,
                       times_from_s(tracker.t_ns, tracker.t_ns.front(), tracker_latency_s),
                       times_from_s(probe.t_ns, tracker.t_ns.front(), probe_latency_s),
                       {}};
  for (const Pose& T_world_marker : tracker.T_world_marker)
    streams.p_world_accelerometer_m.push_back(T_world_marker * recording.calibration.accelerometer_in_marker_m());

  const bool rotation_known = recording.calibration.accelerometer.rotation_known;
  std::vector<double> measured, predicted, ratios, differences, clipped_ratios;
  std::vector<MotionWindow> windows;
  const double begin_s = std::max(streams.pose_s.front(), streams.sample_s.front());
  const double end_s = std::min(streams.pose_s.back(), streams.sample_s.back());
  const double length_s = std::min(kWindow_s, end_s - begin_s);
  for (double start_s = begin_s; length_s > 0.0 && start_s + length_s <= end_s + 1e-9; start_s += kHop_s) {
    const std::optional<PoseRange> poses = poses_between(streams.pose_s, start_s, start_s + length_s);
    if (!poses || (!rotation_known && turns_much(tracker, *poses))) continue;
    const WindowForce force = weighted_force(streams, *poses, start_s, length_s);
    if (force.samples < kFewestPoses || !force.mean_mps2.allFinite()) continue;
    const Eigen::Vector3d tracker_mps2 =
        weighted_acceleration(streams.pose_s, streams.p_world_accelerometer_m, *poses, start_s, length_s);
    const Eigen::Vector3d expected_mps2 = tracker_mps2 - recording.info.gravity_world_mps2;
    const double ratio = force.mean_mps2.norm() / expected_mps2.norm();
    if (force.clipped > 0) {
      clipped_ratios.push_back(ratio);
      continue;
    }
    measured.push_back(force.mean_mps2.norm());
    predicted.push_back(expected_mps2.norm());
    ratios.push_back(ratio);
    if (!rotation_known) continue;
    differences.push_back((force.mean_mps2 - expected_mps2).norm() / expected_mps2.norm());
    MotionWindow& window = windows.emplace_back();
    window.tracker_mps2 = tracker_mps2;
    window.inertial_mps2 = force.mean_mps2 + recording.info.gravity_world_mps2;
    add_rotation(streams.pose_s, tracker, *poses, start_s, length_s, window);
  }
  const WindowScale scale = scale_of_windows(windows);
  out.tracker_scale_error = scale.error;
  out.tracker_scale_error_sigma = scale.sigma;
  out.tracker_axes_chi2 = scale.axes_chi2;
  out.windows = ratios.size();
  out.windows_clipped = clipped_ratios.size();
  out.measured_mps2 = median_over_windows(std::move(measured));
  out.predicted_mps2 = median_over_windows(std::move(predicted));
  out.ratio = median_over_windows(std::move(ratios));
  out.difference_share = median_over_windows(std::move(differences));
  out.clipped_ratio = median_over_windows(std::move(clipped_ratios));
  return out;
}

}  // namespace asperity
