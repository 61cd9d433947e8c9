#include "asperity/pipeline/find_quality_warnings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "asperity/base/units.h"

namespace asperity {

namespace {

constexpr double kGravityTolerance = 0.15;  // share: more than tilt, bias and a moving hand make on the average
constexpr double kLargestBias_mps2 = 1.5;   // five times the prior of a calibrated accelerometer
constexpr double kLatency_sigmas = 5.0;
constexpr double kNoise_ratio = 4.0;  // of the tracker, found over stated
constexpr double kOutlying_share = 0.2;
constexpr double kLost_share = 0.2;  // clipped, or dropped in reading
constexpr double kRepeated_share = 0.5;
constexpr double kLeastOverlap_share = 0.7;

double span_s(const std::vector<std::int64_t>& t_ns) {
  return t_ns.size() < 2 ? 0.0 : static_cast<double>(t_ns.back() - t_ns.front()) * kNanosecond_s;
}

// The length of the mean specific force over half-second windows, its median over the recording: motion of a
// hand averages out.
double usual_specific_force_mps2(const Recording& recording) {
  const ProbeStream& probe = recording.probe;
  std::vector<double> lengths;
  for (std::size_t first = 0; first < probe.size();) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    std::size_t last = first;
    while (last < probe.size() && probe.t_ns[last] - probe.t_ns[first] < 500'000'000) sum += probe.accel_counts[last++];
    const Eigen::Vector3d mean_counts = sum / static_cast<double>(last - first);
    lengths.push_back(recording.calibration.accelerometer.specific_force_mps2(mean_counts).norm());
    first = last;
  }
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  return *middle;
}

double repeated_share(const TrackerStream& tracker) {
  std::size_t repeated = 0;
  for (std::size_t i = 1; i < tracker.size(); ++i) {
    const Pose& a = tracker.T_world_marker[i - 1];
    const Pose& b = tracker.T_world_marker[i];
    repeated += a.translation_m == b.translation_m && a.rotation.coeffs() == b.rotation.coeffs() ? 1 : 0;
  }
  return static_cast<double>(repeated) / static_cast<double>(tracker.size());
}

std::size_t dropped_rows(const Recording& recording) {
  std::size_t dropped = 0;
  for (const Problem& problem : recording.problems) {
    constexpr std::array<std::string_view, 5> kDropped{"duplicate_time", "bad_acceleration", "bad_quaternion",
                                                       "position_far_off", "time_far_off"};
    if (std::find(kDropped.begin(), kDropped.end(), problem.kind) != kDropped.end()) dropped += problem.count;
  }
  return dropped;
}

}  // namespace

std::vector<std::string> find_quality_warnings(const Recording& recording, const TrajectoryResult& trajectory) {
  std::vector<std::string> warnings;
  const auto figure = [&](const char* name) {
    const auto found = trajectory.figures.find(name);
    return found == trajectory.figures.end() ? 0.0 : found->second;
  };

  if (recording.calibration.uncalibrated) warnings.push_back("it was recorded without a calibration: calibrate first");
  const double gravity_mps2 = recording.info.gravity_world_mps2.norm();
  const double force_mps2 = usual_specific_force_mps2(recording);
  if (!(std::abs(force_mps2 - gravity_mps2) <= kGravityTolerance * gravity_mps2)) {
    warnings.push_back(
        fmt::format("the accelerometer reads {:.3g} m/s² on the average where gravity is {:.3g}: check the "
                    "unit of its calibration, and that it is alive",
                    force_mps2, gravity_mps2));
  }
  if (figure("accel_bias_mps2") > kLargestBias_mps2) {
    warnings.push_back(
        fmt::format("the accelerometer's bias would be {:.2g} m/s²: check the signs and axes of its "
                    "calibration, of gravity and of the tracker's world",
                    figure("accel_bias_mps2")));
  }
  if (figure("latency_prior_sigmas") > kLatency_sigmas) {
    warnings.push_back(
        fmt::format("the estimated latency of {:.1f} ms is {:.0f} standard deviations from the calibrated one",
                    1e3 * figure("latency_s"), figure("latency_prior_sigmas")));
  }
  if (figure("tracker_noise_ratio") > kNoise_ratio) {
    warnings.push_back(
        fmt::format("the tracker's residuals are {:.0f} times its calibrated noise", figure("tracker_noise_ratio")));
  }
  if (figure("poses_outlying_share") > kOutlying_share) {
    warnings.push_back(
        fmt::format("{:.0f} of {:.0f} tracker poses disagree with the probe: check the calibration's frames, "
                    "units and latency",
                    figure("poses_outlying"), figure("poses_outlying") + figure("poses_used")));
  }
  if (repeated_share(recording.tracker) > kRepeated_share) warnings.emplace_back("the tracker repeats the same pose");
  if (figure("probe_saturated_share") > kLost_share) {
    warnings.push_back(fmt::format("{:.0f} % of the accelerometer's samples are at the end of its range",
                                   100.0 * figure("probe_saturated_share")));
  }
  const std::size_t dropped = dropped_rows(recording);
  const std::size_t kept = recording.probe.size() + recording.tracker.size();
  if (static_cast<double>(dropped) > kLost_share * static_cast<double>(dropped + kept)) {
    warnings.push_back(fmt::format("{} of {} rows could not be used", dropped, dropped + kept));
  }
  const double recorded_s = std::max(span_s(recording.probe.t_ns), span_s(recording.tracker.t_ns));
  const double used_s = span_s(trajectory.motion.t_ns);
  if (used_s < kLeastOverlap_share * recorded_s) {
    warnings.push_back(fmt::format("the two streams share only {:.1f} s of the {:.1f} s recorded", used_s, recorded_s));
  }
  return warnings;
}

}  // namespace asperity
