#include "asperity/pipeline/compare_with_tracker.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "asperity/base/units.h"
#include "pose_path.h"
#include "smooth_poses.h"

namespace asperity {

namespace {

constexpr std::size_t kMinPathPoses = 16;
constexpr std::array<double, 10> kHalfWidths_s{0.05, 0.07, 0.1, 0.14, 0.2, 0.28, 0.4, 0.56, 0.8, 1.1};
constexpr double kNoiseFloor_m = 1e-6;  // an axis
constexpr double kResting_sigmas = 3.0;
constexpr double kMaxPoseGap_s = 0.3;
constexpr double kShapeError = 0.005;  // of the length
// On the white noise, measured: on scans of 80 mm at an even speed the error over the standard error is 0.23 RMS
// without it and 0.19 with it (the other parts are larger), but where the tip comes to rest or touches for a moment
// only the direction's noise is no small one: there it was 2.3 without it, and right scans were refused.
constexpr double kWhiteMargin = 2.0;

double metric_or(const TrajectoryResult& trajectory, const char* name, double otherwise) {
  const auto found = trajectory.metrics.find(name);
  return found == trajectory.metrics.end() || !std::isfinite(found->second) ? otherwise : found->second;
}

PosePath tip_by_poses(const Recording& recording, const TrajectoryResult& trajectory) {
  const Calibration& calibration = recording.calibration;
  const double latency_s = metric_or(trajectory, "latency_s", calibration.tracker.latency_s);
  PosePath out;
  for (std::size_t i = 0; i < recording.tracker.size(); ++i) {
    out.t_s.push_back(static_cast<double>(recording.tracker.t_ns[i] - trajectory.motion.t_ns.front()) * kNanosecond_s -
                      latency_s);
    out.p_world_tip_m.emplace_back(recording.tracker.T_world_marker[i] * calibration.tip_in_marker_m);
  }
  return out;
}

// The motion's sample at a time, nearest.
std::size_t sample_at(const TipMotion& motion, double t_s) {
  const auto t_ns = motion.t_ns.front() + static_cast<std::int64_t>(std::llround(t_s / kNanosecond_s));
  const auto found = std::lower_bound(motion.t_ns.begin(), motion.t_ns.end(), t_ns);
  const auto i = static_cast<std::size_t>(found - motion.t_ns.begin());
  if (i == 0 || i == motion.size()) return i == 0 ? 0 : motion.size() - 1;
  return t_ns - motion.t_ns[i - 1] < motion.t_ns[i] - t_ns ? i - 1 : i;
}

// The tip at a time within the motion, by a straight line between two samples: at 285 Hz and 0.5 m/s half a sample is
// 0.9 mm.
Eigen::Vector3d tip_at(const TipMotion& motion, double t_s) {
  const double t_ns = static_cast<double>(motion.t_ns.front()) + t_s / kNanosecond_s;
  const auto after =
      std::upper_bound(motion.t_ns.begin() + 1, motion.t_ns.end() - 1, t_ns,
                       [](double t, std::int64_t of_sample) { return t < static_cast<double>(of_sample); });
  const auto i = static_cast<std::size_t>(after - motion.t_ns.begin());
  const auto step_ns = static_cast<double>(motion.t_ns[i] - motion.t_ns[i - 1]);
  const double share = step_ns > 0.0 ? (t_ns - static_cast<double>(motion.t_ns[i - 1])) / step_ns : 0.0;
  return motion.p_world_tip_m[i - 1] +
         std::clamp(share, 0.0, 1.0) * (motion.p_world_tip_m[i] - motion.p_world_tip_m[i - 1]);
}

void compare_positions(const PosePath& path, const TipMotion& motion, const Eigen::Vector3d& sigma_m,
                       TrackerComparison& out) {
  const double end_s = static_cast<double>(motion.t_ns.back() - motion.t_ns.front()) * kNanosecond_s;
  std::vector<double> distances_m;
  for (std::size_t i = 0; i < path.t_s.size(); ++i) {
    if (path.t_s[i] < 0.0 || path.t_s[i] > end_s) continue;
    distances_m.push_back((tip_at(motion, path.t_s[i]) - path.p_world_tip_m[i]).norm());
  }
  if (distances_m.size() < kMinPathPoses) return;
  const auto middle = distances_m.begin() + static_cast<std::ptrdiff_t>(distances_m.size() / 2);
  std::nth_element(distances_m.begin(), middle, distances_m.end());
  out.departure_m = *middle;
  // The median length of noise is nearly its root mean square: 0.89 of it for three equal axes, 0.67 for one.
  out.departure_ratio = out.departure_m / (0.8 * sigma_m.norm());
}

struct PathLength {
  double length_m = 0.0;
  double variance_m2 = 0.0;
  double noise_m = 0.0;     // that noise in the direction adds
  double resting_m = 0.0;   // from the beginning to the end of each rest
  double unsure_m = 0.0;    // the speed's sum at rest: in a narrow smoothing noise decides what is rest
  double missed_m = 0.0;    // that between the first and the last motion
  double reversed_m = 0.0;  // that the smoothing may hide where the path turns round
};

// Poses that follow one another in contact, [first, last).
struct ContactRun {
  std::size_t first = 0, last = 0;
};

std::vector<ContactRun> contact_runs(const PosePath& path, const TipMotion& motion, const BasePathResult& base) {
  const double end_s = static_cast<double>(motion.t_ns.back() - motion.t_ns.front()) * kNanosecond_s;
  std::vector<ContactRun> out;
  bool open = false;
  for (std::size_t i = 0; i < path.t_s.size(); ++i) {
    const bool touches =
        path.t_s[i] >= 0.0 && path.t_s[i] <= end_s && base.contact[sample_at(motion, path.t_s[i])] != 0;
    const bool gap = open && path.t_s[i] - path.t_s[i - 1] > kMaxPoseGap_s;
    if (touches && (!open || gap)) out.push_back({i, i});
    if (touches) out.back().last = i + 1;
    open = touches;
  }
  std::erase_if(out, [](const ContactRun& run) { return run.last - run.first < 3; });
  return out;
}

// Where a raster turns round within a smoothing's width, the smoothed speed falls, and what is lacking of that before
// and behind is path that is not seen. All of it, for a tip that does not slow down.
double hidden_by_reversals_m(const PosePath& path, const ContactRun& run, const SmoothedPoses& direction,
                             const PoseNoise& noise, double half_width_s) {
  constexpr double kTurnsRound = 0.5;  // cosine of 60°
  double out_m = 0.0;
  std::size_t before = run.first, after = run.first;
  for (std::size_t i = run.first; i + 1 < run.last; ++i) {
    while (path.t_s[before] < path.t_s[i] - half_width_s) ++before;
    while (after + 1 < run.last && path.t_s[after] < path.t_s[i] + half_width_s) ++after;
    const Eigen::Vector3d &a = direction.v_mps[before], &b = direction.v_mps[after];
    if (!(a.norm() > kResting_sigmas * direction.v_sigma_mps(before, noise)) ||
        !(b.norm() > kResting_sigmas * direction.v_sigma_mps(after, noise)) ||
        !(a.dot(b) < kTurnsRound * a.norm() * b.norm()))
      continue;
    out_m += std::max(0.0, 0.5 * (a.norm() + b.norm()) - direction.v_mps[i].norm()) * (path.t_s[i + 1] - path.t_s[i]);
  }
  return out_m;
}

// Σ Δq·u over a run, u from `direction`, q from `position`.
PathLength measure_run(const PosePath& path, const ContactRun& run, const SmoothedPoses& direction,
                       const SmoothedPoses& position, const TipMotion& motion, const BasePathResult& base,
                       const PoseNoise& noise, double half_width_s) {
  PathLength out;
  Eigen::Vector3d u_before = Eigen::Vector3d::Zero();
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();
  double turn_begins_s = path.t_s[run.first];
  std::size_t rest_begins = run.last;  // the run's last: no rest
  double resting_m = 0.0;
  const auto end_rest = [&](std::size_t at) {
    if (rest_begins < at) out.resting_m += (position.p_m[at] - position.p_m[rest_begins]).norm();
    rest_begins = run.last;
  };
  for (std::size_t i = run.first; i + 1 < run.last; ++i) {
    const double dt_s = path.t_s[i + 1] - path.t_s[i];
    const Eigen::Vector3d& n = base.path.n_world[sample_at(motion, 0.5 * (path.t_s[i] + path.t_s[i + 1]))];
    Eigen::Vector3d v_mps = 0.5 * (direction.v_mps[i] + direction.v_mps[i + 1]);
    v_mps -= v_mps.dot(n) * n;
    const double speed_mps = v_mps.norm();
    const double sigma_v_mps = direction.v_sigma_mps(i, noise);
    Eigen::Vector3d u = Eigen::Vector3d::Zero();
    if (speed_mps > kResting_sigmas * sigma_v_mps) {
      end_rest(i);
      if (out.length_m > 0.0) out.missed_m += resting_m;
      resting_m = 0.0;
      u = v_mps / speed_mps;
      out.length_m += (position.p_m[i + 1] - position.p_m[i]).dot(u);
      out.noise_m += 0.5 * sigma_v_mps * sigma_v_mps / speed_mps * dt_s;
    } else {
      out.unsure_m += speed_mps * dt_s;
      resting_m += speed_mps * dt_s;
      if (rest_begins == run.last) rest_begins = i;
    }
    turn += u - u_before;
    u_before = u;
    // The noise of q lasts for about the smoothing's width: what u turns within it counts together.
    if (path.t_s[i] - turn_begins_s > half_width_s || i + 2 == run.last) {
      out.variance_m2 += turn.cwiseProduct(position.p_sigma_m(i, noise)).squaredNorm();
      turn.setZero();
      turn_begins_s = path.t_s[i];
    }
  }
  end_rest(run.last - 1);
  constexpr double kHidden = 0.5;  // half circles hide about half of what their speed lacks
  out.reversed_m = kHidden * hidden_by_reversals_m(path, run, direction, noise, half_width_s);
  out.variance_m2 += u_before.cwiseProduct(position.p_sigma_m(run.last - 1, noise)).squaredNorm();
  return out;
}

// Our length over the runs, with what the motion's covariance makes of it.
void measure_own(const PosePath& path, const std::vector<ContactRun>& runs, const TipMotion& motion,
                 const BasePathResult& base, TrackerComparison& out) {
  double variance_m2 = 0.0;
  // The poses' path is that of the tip as well.
  const std::vector<double>& s_m = base.tip_s_m.empty() ? base.path.s_m : base.tip_s_m;
  out.length_m = 0.0;
  for (const ContactRun& run : runs) {
    const std::size_t first = sample_at(motion, path.t_s[run.first]), last = sample_at(motion, path.t_s[run.last - 1]);
    out.length_m += s_m[last] - s_m[first];
    if (motion.cov_world_tip_m2.empty()) continue;
    for (const std::size_t end : {first, last}) {
      const Eigen::Vector3d& n = base.path.n_world[end];
      const Eigen::Vector3d u = motion.v_world_tip_mps[end] - motion.v_world_tip_mps[end].dot(n) * n;
      if (u.norm() > 0.0) variance_m2 += u.normalized().dot(motion.cov_world_tip_m2[end] * u.normalized());
    }
  }
  if (!motion.cov_world_tip_m2.empty()) out.length_stderr_m = std::sqrt(variance_m2);
}

// The poses' length at the smoothing at which its standard error is least. What a smoothing bends is at least what its
// length differs from that of any narrower one by more than that one's noise (Goldenshluger and Lepski, Ann. Stat. 39,
// 2011): the difference from the next alone may happen to be small where all of them grow.
void measure_tracker(const PosePath& path, const std::vector<ContactRun>& runs, const TipMotion& motion,
                     const BasePathResult& base, const PoseNoise& noise, TrackerComparison& out) {
  const std::vector<double> decay = decay_between(path.t_s, noise.slow_time_s);
  SmoothedPoses narrower;
  double narrower_m = TrackerComparison::kUnknown;
  std::vector<PathLength> before;
  for (const double half_width_s : kHalfWidths_s) {
    SmoothedPoses smoothed = smooth_poses(path, half_width_s, decay);
    PathLength total;
    for (const ContactRun& run : runs) {
      const PathLength part = measure_run(path, run, smoothed, narrower.p_m.empty() ? smoothed : narrower, motion, base,
                                          noise, half_width_s);
      total.length_m += part.length_m;
      total.variance_m2 += part.variance_m2;
      total.noise_m += part.noise_m;
      total.resting_m += part.resting_m;
      total.unsure_m += part.unsure_m;
      total.missed_m += part.missed_m;
      total.reversed_m += part.reversed_m;
    }
    double bent_m2 = std::pow(total.length_m - narrower_m, 2);
    for (const PathLength& one : before) {
      const double apart_m = std::max(0.0, std::abs(total.length_m - one.length_m) - one.unsure_m);
      bent_m2 = std::fmax(bent_m2, apart_m * apart_m - one.variance_m2 - std::pow(one.noise_m, 2));
    }
    before.push_back(total);
    const double stderr_m =
        std::sqrt(total.variance_m2 + std::pow(total.noise_m, 2) + std::pow(total.resting_m, 2) +
                  std::pow(total.reversed_m, 2) + bent_m2 + std::pow(kShapeError * total.length_m, 2));
    // In a smoothing in which noise lets most of the path seem at rest nothing is measured.
    const bool measured = std::isfinite(stderr_m) && total.length_m > total.missed_m;
    if (measured && !(stderr_m >= out.tracker_length_stderr_m)) {
      out.tracker_length_m = total.length_m;
      out.tracker_length_stderr_m = stderr_m;
      out.smoothing_s = half_width_s;
    }
    narrower_m = total.length_m;
    narrower = std::move(smoothed);
  }
}

// The slow part is what the trajectory has learnt of it, otherwise what the calibration states; rotations move the tip
// about the marker.
PoseNoise pose_noise(const Recording& recording, const TrajectoryResult& trajectory, const Eigen::Vector3d& white_m) {
  const TrackerCalibration& tracker = recording.calibration.tracker;
  PoseNoise out;
  out.white_m = kWhiteMargin * white_m;
  out.slow_time_s = metric_or(trajectory, "tracker_slow_time_s", tracker.slow_time_s.value_or(1.0));
  const double lever_m = recording.calibration.tip_in_marker_m.norm();
  const double turn_rad = metric_or(trajectory, "tracker_slow_sigma_rad", 0.0);
  const double stated_m = tracker.slow_sigma_m ? tracker.slow_sigma_m->norm() / std::sqrt(3.0) : 0.0;
  out.slow_m.setConstant(std::hypot(metric_or(trajectory, "tracker_slow_sigma_m", stated_m), lever_m * turn_rad));
  return out;
}

}  // namespace

TrackerComparison compare_with_tracker(const Recording& recording, const TrajectoryResult& trajectory,
                                       const BasePathResult& base) {
  TrackerComparison out;
  const TipMotion& motion = trajectory.motion;
  if (motion.size() < 2 || recording.tracker.size() < kMinPathPoses) return out;
  const PosePath all = tip_by_poses(recording, trajectory);
  const Eigen::Vector3d sigma_m = white_noise_m(all).cwiseMax(kNoiseFloor_m);
  const PosePath path = without_outliers(all, sigma_m);
  if (path.t_s.size() < kMinPathPoses) return out;
  out.pose_noise_m = sigma_m.norm() / std::sqrt(3.0);
  compare_positions(all, motion, sigma_m, out);
  if (base.path.size() != motion.size() || base.contact.size() != motion.size()) return out;

  const std::vector<ContactRun> runs = contact_runs(path, motion, base);
  if (runs.empty()) return out;
  measure_own(path, runs, motion, base, out);
  measure_tracker(path, runs, motion, base, pose_noise(recording, trajectory, sigma_m), out);
  return out;
}

}  // namespace asperity
