#include "fused_problem.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include <Eigen/SVD>

#include "asperity/base/error.h"
#include "fused_setup.h"

namespace asperity::inertial_smoother {

namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

double seconds(std::int64_t t_ns, std::int64_t origin_ns) { return static_cast<double>(t_ns - origin_ns) * 1e-9; }

}  // namespace

Knot at_sample(const InertialStream& inertial, std::size_t i, std::int64_t origin_ns) {
  Knot knot;
  knot.t = seconds(inertial.t_ns[i], origin_ns);
  knot.f = inertial.specific_force_mps2[i];
  knot.w = inertial.angular_rate_radps[i];
  knot.sample = static_cast<std::int64_t>(i);
  return knot;
}

// Noise densities of the segment between samples i and i+1.
void set_noise(const InertialStream& inertial, const FusedConfig& config, std::size_t i, Knot& knot) {
  const double period = inertial.period_s;
  const double dt = static_cast<double>(inertial.t_ns[i + 1] - inertial.t_ns[i]) * 1e-9;
  double accel = std::max(inertial.accel_sigma_mps2[i], inertial.accel_sigma_mps2[i + 1]);
  const double gyro = std::max(inertial.gyro_sigma_radps[i], inertial.gyro_sigma_radps[i + 1]);
  const double change = (inertial.specific_force_mps2[i + 1] - inertial.specific_force_mps2[i]).norm();
  double correlation = period;
  if (dt > 1.5 * period) {  // lost samples: the straight line between what was there is a guess
    const double lost = std::min(1.0, (dt / period - 1.0) / 10.0);
    accel = std::hypot(accel, std::max(lost * config.inertial.gap_sigma_mps2, 0.5 * change));
    correlation = std::min(dt, 0.02);
  }
  const double moving =
      config.inertial.scale_error * std::max(inertial.accel_moving_mps2[i], inertial.accel_moving_mps2[i + 1]);
  const double jitter = dt > 0.0 ? config.inertial.sample_time_sigma_s * change / dt : 0.0;
  const double turning = inertial.has_gyro ? config.inertial.rate_error * inertial.angular_rate_radps[i].norm() : 0.0;
  knot.accel_psd = {accel * accel * correlation, moving * moving * correlation, jitter * jitter * correlation};
  knot.accel_fast = static_cast<float>(correlation) * inertial.accel_fast_m2ps4[i];
  knot.gyro_psd = {gyro * gyro * correlation, turning * turning * correlation};
  if (inertial.has_gyro && dt > 5.0 * period) knot.gyro_psd[0] = std::max(knot.gyro_psd[0], 0.25 * correlation);
}

Knot between_samples(const InertialStream& inertial, const FusedConfig& config, std::size_t after, double t_s,
                     std::int64_t origin_ns) {
  const Knot k0 = at_sample(inertial, after - 1, origin_ns);
  const Knot k1 = at_sample(inertial, after, origin_ns);
  const double share = std::clamp((t_s - k0.t) / (k1.t - k0.t), 0.0, 1.0);
  Knot knot;
  knot.t = t_s;
  knot.f = k0.f + share * (k1.f - k0.f);
  knot.w = k0.w + share * (k1.w - k0.w);
  set_noise(inertial, config, after - 1, knot);
  return knot;
}

namespace {

// The probe's samples, and instants between them.
class StreamKnots : public KnotSource {
 public:
  StreamKnots(const InertialStream& inertial, const FusedConfig& config, std::int64_t origin_ns)
      : inertial_(&inertial), config_(&config), origin_ns_(origin_ns) {
    from_.reserve(inertial.size());
  }

  void add_sample(std::size_t sample) { from_.push_back(static_cast<std::int32_t>(sample)); }
  void add_between(std::size_t after, double t_s) {
    from_.push_back(-1 - static_cast<std::int32_t>(between_.size()));
    between_.push_back({after, t_s});
  }

  std::size_t size() const override { return from_.size(); }
  Knot knot(std::size_t k) const override {
    if (from_[k] < 0) {
      const Between& at = between_[static_cast<std::size_t>(-1 - from_[k])];
      return between_samples(*inertial_, *config_, at.after, at.t_s, origin_ns_);
    }
    const auto sample = static_cast<std::size_t>(from_[k]);
    Knot out = at_sample(*inertial_, sample, origin_ns_);
    if (sample + 1 < inertial_->size()) set_noise(*inertial_, *config_, sample, out);
    return out;
  }
  std::int64_t sample(std::size_t k) const override { return from_[k] < 0 ? Knot{}.sample : from_[k]; }

 private:
  struct Between {
    std::size_t after = 0;  // the sample after it
    double t_s = 0.0;
  };
  const InertialStream* inertial_;
  const FusedConfig* config_;
  std::int64_t origin_ns_;
  std::vector<std::int32_t> from_;  // each knot's sample; -1 - i: the instant i between two
  std::vector<Between> between_;
};

}  // namespace

Problem make_problem(const Recording& recording, const InertialStream& inertial, const FusedConfig& config,
                     double latency_s, std::int64_t origin_ns) {
  const TrackerStream& tracker = recording.tracker;
  const double begin = seconds(inertial.t_ns.front(), origin_ns);
  const double end = seconds(inertial.t_ns.back(), origin_ns);
  Problem problem;
  std::vector<double> pose_t(tracker.size());
  std::size_t inside = 0;
  std::size_t first_pose = tracker.size();
  for (std::size_t i = 0; i < tracker.size(); ++i) {
    pose_t[i] = seconds(tracker.t_ns[i], origin_ns) - latency_s;
    if (pose_t[i] < begin || pose_t[i] > end) continue;
    first_pose = std::min(first_pose, i);
    ++inside;
  }
  if (inside < 4) {
    throw Error("tracker.csv: only " + std::to_string(inside) +
                " poses lie within the probe's time span; at least 4 are needed: record both at once, "
                "or correct the calibration's latency");
  }
  problem.poses = tracker.T_world_marker;
  problem.pose_noise = stated_pose_noise(tracker, recording.calibration, recording.info);
  problem.position_weight.assign(tracker.size(), 0.0);
  problem.rotation_weight.assign(tracker.size(), 0.0);

  const std::size_t last_pose = first_pose + inside;
  std::size_t next_sample = static_cast<std::size_t>(
      std::lower_bound(inertial.t_ns.begin(), inertial.t_ns.end(), origin_ns + std::llround(pose_t[first_pose] * 1e9)) -
      inertial.t_ns.begin());
  next_sample = std::min(next_sample, inertial.size() - 1);
  // The first epoch is the first knot: the pose's time is no whole nanosecond, the sample's is.
  if (next_sample + 1 < inertial.size() && seconds(inertial.t_ns[next_sample], origin_ns) < pose_t[first_pose]) {
    ++next_sample;
  }
  auto knots = std::make_shared<StreamKnots>(inertial, config, origin_ns);
  double last_epoch_t = pose_t[first_pose];
  const auto add_epoch = [&](std::int64_t pose, double t) {
    problem.epochs.push_back({knots->size() - 1, pose});
    last_epoch_t = t;
  };
  for (std::size_t i = first_pose; i < last_pose; ++i) {
    // Probe samples strictly before the pose, then the pose itself.
    for (; next_sample < inertial.size(); ++next_sample) {
      const double t = seconds(inertial.t_ns[next_sample], origin_ns);
      if (!(t < pose_t[i])) break;
      knots->add_sample(next_sample);
      if (t - last_epoch_t > kLongestInterval_s) add_epoch(-1, t);
    }
    if (next_sample < inertial.size() && seconds(inertial.t_ns[next_sample], origin_ns) == pose_t[i]) {
      knots->add_sample(next_sample++);
    } else {
      knots->add_between(std::clamp<std::size_t>(next_sample, 1, inertial.size() - 1), pose_t[i]);
    }
    add_epoch(static_cast<std::int64_t>(i), pose_t[i]);
  }
  problem.knots = KnotLine(std::move(knots));
  return problem;
}

namespace {

// The pose, of those in [first, last), with the least sum of orientation and position differences to the
// others: no wild one can win.
std::size_t medoid(const std::vector<Pose>& poses, std::size_t first, std::size_t last) {
  std::size_t best = first;
  double best_sum = std::numeric_limits<double>::infinity();
  for (std::size_t i = first; i < last; ++i) {
    double sum = 0.0;
    for (std::size_t j = first; j < last; ++j) {
      sum += poses[i].rotation.angularDistance(poses[j].rotation) +
             (poses[i].translation_m - poses[j].translation_m).norm();
    }
    if (sum < best_sum) best_sum = sum, best = i;
  }
  return best;
}

// The rotation marker ← sensor that turns the measured specific force into Rᵀ(a − g), a from the poses'
// second difference over half a second (Wahba's problem, 1965, by SVD).
Quaterniond sensor_rotation(const Problem& problem, const Vector3d& gravity) {
  Matrix3d moment = Matrix3d::Zero();
  std::vector<std::size_t> with_pose;
  for (const Epoch& epoch : problem.epochs) {
    if (epoch.pose >= 0) with_pose.push_back(epoch.knot);
  }
  std::vector<std::size_t> pose_of(with_pose.size());
  std::size_t count = 0;
  for (const Epoch& epoch : problem.epochs) {
    if (epoch.pose >= 0) pose_of[count++] = static_cast<std::size_t>(epoch.pose);
  }
  std::vector<Vector3d> running(problem.knots.size() + 1, Vector3d::Zero());
  for (std::size_t k = 0; k < problem.knots.size(); ++k) running[k + 1] = running[k] + problem.knots[k].f;
  constexpr double kHalfWindow_s = 0.12;
  const double rate = static_cast<double>(with_pose.size()) /
                      std::max(1e-3, problem.knots[with_pose.back()].t - problem.knots[with_pose.front()].t);
  const auto half = static_cast<std::size_t>(std::max(1.0, std::round(kHalfWindow_s * rate)));
  for (std::size_t i = half; i + half < with_pose.size(); ++i) {
    const double h0 = problem.knots[with_pose[i]].t - problem.knots[with_pose[i - half]].t;
    const double h1 = problem.knots[with_pose[i + half]].t - problem.knots[with_pose[i]].t;
    if (h0 > 3.0 * kHalfWindow_s || h1 > 3.0 * kHalfWindow_s) continue;
    const Pose& pose = problem.poses[pose_of[i]];
    const Vector3d slope0 = (pose.translation_m - problem.poses[pose_of[i - half]].translation_m) / h0;
    const Vector3d slope1 = (problem.poses[pose_of[i + half]].translation_m - pose.translation_m) / h1;
    const Vector3d a = 2.0 * (slope1 - slope0) / (h0 + h1);
    if (a.norm() > 5.0) continue;  // a wild pose
    const Vector3d expected = pose.rotation.conjugate() * (a - gravity);
    // The mean specific force over the same window.
    const std::size_t k0 = with_pose[i - half];
    const std::size_t k1 = with_pose[i + half];
    const Vector3d mean = (running[k1] - running[k0]) / static_cast<double>(k1 - k0);
    moment += expected * mean.transpose();
  }
  const Eigen::JacobiSVD<Matrix3d> svd(moment, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Vector3d sign(1.0, 1.0, (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0.0 ? -1.0 : 1.0);
  return Quaterniond(Matrix3d(svd.matrixU() * sign.asDiagonal() * svd.matrixV().transpose())).normalized();
}

}  // namespace

Pose typical_pose(const Problem& problem, std::size_t epoch) {
  const auto first = static_cast<std::size_t>(problem.epochs[epoch].pose);
  std::size_t last = first;
  const double t0 = problem.knots[problem.epochs[epoch].knot].t;
  for (std::size_t e = epoch; e < problem.epochs.size(); ++e) {
    const bool near = problem.knots[problem.epochs[e].knot].t - t0 < 0.25 || last - first < 3;
    if (!near) break;
    if (problem.epochs[e].pose >= 0) last = static_cast<std::size_t>(problem.epochs[e].pose) + 1;
  }
  last = std::min(last, first + 100);
  return problem.poses[medoid(problem.poses, first, last)];
}

Nominal first_guess(const Recording& recording, const Problem& problem) {
  Nominal guess;
  const Pose pose = typical_pose(problem, 0);
  guess.lever = recording.calibration.accelerometer_in_marker_m();
  guess.q = pose.rotation;
  guess.p = pose * guess.lever;
  if (!recording.calibration.accelerometer.rotation_known) {
    guess.misalignment = sensor_rotation(problem, recording.info.gravity_world_mps2);
  }
  return guess;
}

Problem first_stretch(const Problem& problem, double length_s) {
  Problem out = problem;
  const double begin = problem.knots.front().t;
  if (problem.knots.back().t - begin <= 1.5 * length_s) return out;
  const auto last = std::find_if(out.epochs.begin(), out.epochs.end(),
                                 [&](const Epoch& e) { return out.knots[e.knot].t > begin + length_s; });
  out.epochs.erase(last, out.epochs.end());
  out.knots.shorten(out.epochs.back().knot + 1);
  return out;
}

void choose_mounting(Problem& problem, bool has_gyro) {
  constexpr double kStretch_s = 5.0;
  constexpr int kTurns = 12;
  Problem trial = first_stretch(problem, kStretch_s);
  Vector3d mean_force = Vector3d::Zero();
  for (std::size_t k = 0; k < trial.knots.size(); ++k) mean_force += trial.knots[k].f;
  const Eigen::Quaterniond guess = problem.start.misalignment;
  const Vector3d axis_marker = (guess * mean_force).normalized();
  double best = -std::numeric_limits<double>::infinity();
  for (int turn = 0; turn < kTurns; ++turn) {
    const double angle = 2.0 * std::numbers::pi * turn / kTurns;
    trial.start.misalignment = (exp_rotation(angle * axis_marker) * guess).normalized();
    for (const bool gyro_turns_too : {true, false}) {
      if (!has_gyro && !gyro_turns_too) continue;
      trial.gyro_turns_too = gyro_turns_too;
      const double likelihood = log_likelihood(trial);
      if (!(likelihood > best)) continue;
      best = likelihood;
      problem.gyro_turns_too = gyro_turns_too;
      problem.start.misalignment = trial.start.misalignment;
    }
  }
}

}  // namespace asperity::inertial_smoother
