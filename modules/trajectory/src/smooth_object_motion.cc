#include "asperity/trajectory/smooth_object_motion.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <Eigen/Cholesky>

#include "asperity/base/error.h"
#include "fused_setup.h"
#include "inertial_smoother.h"
#include "motion_chart.h"

namespace asperity {

namespace {

using Eigen::Vector3d;
using motion_chart::ChartKind;
using motion_chart::Learnt;
using motion_chart::Measured;
using motion_chart::Path;

constexpr double kStatedWeight = 10.0;    // observations that a stated noise is worth, as in learn_noise.h
constexpr double kMedianChi2 = 2.366;     // 3 degrees of freedom
constexpr double kWorseThanStated = 1.5;  // standard deviations: beyond, the stated ones are scaled first
constexpr double kSettled = 0.02;         // change of a logarithm below which nothing more is learnt
constexpr double kFastAccel_m2ps3 = 0.1;  // of a hand in a hurry: the first pass refuses no good pose
constexpr double kFastAngular_rad2ps3 = 30.0;
constexpr double kLeastDensity = 1e-12;

// The most typical of the first poses: no wild one.
std::size_t typical_of_first(const std::vector<Pose>& poses) {
  const std::size_t first = std::min<std::size_t>(poses.size(), 7);
  std::size_t best = 0;
  double least = INFINITY;
  for (std::size_t i = 0; i < first; ++i) {
    double sum = 0.0;
    for (std::size_t k = 0; k < first; ++k) {
      constexpr double kArm_m = 0.05;  // weighs a rotation as what it moves there
      sum +=
          (poses[i].translation_m - poses[k].translation_m).norm() + kArm_m * rotation_between_rad(poses[i], poses[k]);
    }
    if (sum < least) best = i;
    least = std::min(least, sum);
  }
  return best;
}

double median_of(std::vector<double> values) {
  const auto half = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), half, values.end());
  return *half;
}

// One of position and rotation: smoothed again until its noise is learnt.
struct Smoothing {
  Path path;
  Vector3d density;
  Vector3d noise_factor = Vector3d::Ones();  // on the variances as stated
  std::vector<double> weight;
};

Smoothing smooth_chart(ChartKind kind, const Measured& measured, double first_density,
                       const ObjectSmootherConfig& config) {
  Smoothing out;
  out.density = Vector3d::Constant(first_density);
  out.weight.assign(measured.t_s.size(), 1.0);
  for (int pass = 0; pass < config.passes; ++pass) {
    const bool first = pass == 0;
    out.path =
        motion_chart::smooth(kind, measured, out.density, out.noise_factor, out.weight, first ? config.gate_chi2 : 0.0);
    // A tracker that is worse than stated is no outlier; the first density is too wide to tell its noise by.
    if (first) {
      const double excess = median_of(out.path.chi2) / kMedianChi2;
      if (excess > kWorseThanStated * kWorseThanStated) out.noise_factor *= excess;
    }
    for (std::size_t i = 0; i < out.weight.size(); ++i)
      out.weight[i] =
          inertial_smoother::redescending(out.path.chi2[i] / (first ? out.noise_factor.mean() : 1.0), config.gate_chi2);
    if (pass + 1 == config.passes) break;
    const Learnt learnt = motion_chart::learn(kind, measured, out.path, out.density, out.noise_factor, out.weight);
    double change = 0.0;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      const double motion = learnt.density_seen[axis] / std::max(learnt.density_expected[axis], 1e-9);
      const double next = std::clamp(out.density[axis] * motion, kLeastDensity, 1e6);
      change = std::max(change, std::abs(std::log(next / out.density[axis])));
      out.density[axis] = next;
      const double factor = out.noise_factor[axis];
      const double noise =
          (learnt.noise_seen[axis] + kStatedWeight / factor) / (learnt.noise_expected[axis] + kStatedWeight);
      change = std::max(change, std::abs(std::log(noise)));
      out.noise_factor[axis] = factor * noise;
    }
    if (change < kSettled) {
      out.path = motion_chart::smooth(kind, measured, out.density, out.noise_factor, out.weight, 0.0);
      break;
    }
  }
  return out;
}

Vector3d rms_of(const std::vector<Eigen::Matrix3d>& variance, const Vector3d& factor) {
  Vector3d sum = Vector3d::Zero();
  for (const Eigen::Matrix3d& one : variance) sum += one.diagonal();
  return (sum.cwiseProduct(factor) / static_cast<double>(variance.size())).cwiseSqrt();
}

double mean_frame_s(const std::vector<double>& t_s, double longest_gap_s) {
  double sum_s = 0.0, count = 0.0;
  for (std::size_t i = 1; i < t_s.size(); ++i) {
    if (t_s[i] - t_s[i - 1] > longest_gap_s) continue;
    sum_s += t_s[i] - t_s[i - 1];
    count += 1.0;
  }
  return count > 0.0 ? sum_s / count : 0.0;
}

}  // namespace

ObjectMotion smooth_object_motion(const TrackerStream& poses, const Calibration& calibration, const RecordingInfo& info,
                                  double latency_s, const ObjectSmootherConfig& config) {
  constexpr std::size_t kFewest = 4;
  if (poses.size() < kFewest) {
    throw Error("the object's body: " + std::to_string(poses.size()) +
                " poses; at least 4 are needed: scan again with its markers in the camera's view");
  }
  ObjectMotion out;
  Measured position, rotation;
  const std::vector<inertial_smoother::PoseNoise> stated =
      inertial_smoother::stated_pose_noise(poses, calibration, info, kObjectBody);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    out.t_ns.push_back(poses.t_ns[i] - std::llround(latency_s * 1e9));
    position.t_s.push_back(static_cast<double>(poses.t_ns[i] - poses.t_ns.front()) * 1e-9);
    position.variance.push_back(stated[i].position_m2);
    rotation.variance.push_back(stated[i].rotation_rad2);
  }
  rotation.t_s = position.t_s;
  position.poses = rotation.poses = poses.T_world_marker;
  position.first = rotation.first = typical_of_first(poses.T_world_marker);
  const Smoothing moved = smooth_chart(ChartKind::kPosition, position, kFastAccel_m2ps3, config);
  const Smoothing turned = smooth_chart(ChartKind::kRotation, rotation, kFastAngular_rad2ps3, config);
  constexpr double kOutlyingWeight = 0.5;  // of a pose's weight
  for (std::size_t i = 0; i < poses.size(); ++i) {
    out.T_world_object.push_back({turned.path.pose[i].rotation, moved.path.pose[i].translation_m});
    out.outlying += moved.weight[i] < kOutlyingWeight || turned.weight[i] < kOutlyingWeight ? 1 : 0;
  }
  out.position = moved.path.knots;
  out.rotation = turned.path.knots;
  out.longest_gap_s = config.longest_gap_s;
  ObjectNoise& noise = out.noise;
  noise.accel_m2ps3 = moved.density;
  noise.angular_rad2ps3 = turned.density;
  noise.pose_m = rms_of(position.variance, moved.noise_factor);
  noise.pose_rad = rms_of(rotation.variance, turned.noise_factor);
  FusedConfig slow;
  slow.slow_share = config.slow_share;
  const Eigen::Matrix<double, 6, 1> slow_sigma = inertial_smoother::slow_sigma(calibration, slow);
  noise.slow_m = slow_sigma.head<3>();
  noise.slow_rad = slow_sigma.tail<3>();
  noise.slow_time_s = calibration.tracker.slow_time_s.value_or(config.slow_time_s);
  noise.frame_s = mean_frame_s(position.t_s, config.longest_gap_s);
  return out;
}

}  // namespace asperity
