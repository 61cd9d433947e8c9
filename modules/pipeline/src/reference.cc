#include "asperity/pipeline/reference.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "asperity/base/error.h"
#include "asperity/trajectory/refer_to_object.h"

namespace asperity {

namespace {

constexpr double kHardlySeen = 0.02;  // of the samples
constexpr std::size_t kFewestPoses = 4;

// When the poses were taken, on the motion's clock.
double pose_latency_s(const Recording& recording, const TrajectoryResult& trajectory) {
  const auto found = trajectory.metrics.find("latency_s");
  return found != trajectory.metrics.end() && std::isfinite(found->second) ? found->second
                                                                           : recording.calibration.tracker.latency_s;
}

double median_sigma_m(const CovarianceLine& covariance_m2) {
  if (covariance_m2.empty()) return 0.0;
  std::vector<double> sigma_m;
  for (const Eigen::Matrix3d& one : covariance_m2) sigma_m.push_back(std::sqrt(std::max(0.0, one.trace() / 3.0)));
  const auto half = sigma_m.begin() + static_cast<std::ptrdiff_t>(sigma_m.size() / 2);
  std::nth_element(sigma_m.begin(), half, sigma_m.end());
  return *half;
}

// How far the scanned part of the object has moved from where it was first, and rotated.
void note_motion(const ObjectMotion& object, const TipMotion& tip, std::map<std::string, double>& metrics) {
  Eigen::Vector3d middle_m = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p_m : tip.p_world_tip_m) middle_m += p_m / static_cast<double>(tip.size());
  const Pose first = object.at(tip.t_ns.front()).T_world_object;
  double moved_m = 0.0, turned_rad = 0.0;
  for (std::size_t i = 0; i < object.size(); ++i) {
    if (object.t_ns[i] < tip.t_ns.front() || object.t_ns[i] > tip.t_ns.back()) continue;
    const Pose& now = object.T_world_object[i];
    moved_m = std::max(moved_m, (now * middle_m - first * middle_m).norm());
    turned_rad = std::max(turned_rad, rotation_between_rad(first, now));
  }
  metrics["object_moved_m"] = moved_m;
  metrics["object_turned_rad"] = turned_rad;
}

void note_noise(const ObjectMotion& object, std::map<std::string, double>& metrics) {
  const ObjectNoise& noise = object.noise;
  const auto give = [&](const std::string& name, const std::string& unit, const Eigen::Vector3d& value) {
    for (Eigen::Index axis = 0; axis < 3; ++axis)
      metrics["object_" + name + "_" + std::string(1, "xyz"[axis]) + unit] = value[axis];
  };
  give("pose_sigma", "_m", noise.pose_m);
  give("pose_sigma_r", "_rad", noise.pose_rad);
  give("accel", "_mps2_rtHz", noise.accel_m2ps3.cwiseSqrt());
  give("angular_accel", "_radps2_rtHz", noise.angular_rad2ps3.cwiseSqrt());
  metrics["object_frame_s"] = noise.frame_s;
  metrics["object_poses"] = static_cast<double>(object.size());
  metrics["object_poses_outlying"] = static_cast<double>(object.outlying);
}

}  // namespace

void refer_trajectory(const Recording& recording, Reference reference, const ObjectSmootherConfig& config,
                      TrajectoryResult& trajectory) {
  if (reference == Reference::kWorld) return;
  const TrackerStream* poses = recording.poses_of(kObjectBody);
  if (poses == nullptr) {
    if (reference == Reference::kAuto) return;
    throw Error("reference: object, but the recording has no body 'object'");
  }
  trajectory.metrics["object_seen_share"] = 0.0;
  if (poses->size() < kFewestPoses || trajectory.motion.size() == 0) {
    trajectory.problems.push_back({"object_unseen", fmt::format("{} poses of the object's body", poses->size()), 1});
    return;
  }
  ObjectMotion object = smooth_object_motion(*poses, recording.calibration, recording.info,
                                             pose_latency_s(recording, trajectory), config);
  const std::size_t samples = trajectory.motion.size();
  TipMotion tip = refer_to_object(trajectory.motion, object);
  const double seen_share = static_cast<double>(tip.size()) / static_cast<double>(samples);
  trajectory.metrics["object_seen_share"] = seen_share;
  if (seen_share < kHardlySeen) {
    trajectory.problems.push_back({"object_unseen", "the object's body was almost never seen", 1});
    return;
  }
  if (tip.size() < samples) {
    trajectory.problems.push_back({"object_unseen",
                                   "samples of the probe while the object's body was not seen; they were left out",
                                   samples - tip.size()});
  }
  trajectory.metrics["object_sigma_m"] =
      std::sqrt(std::max(0.0, std::pow(median_sigma_m(tip.cov_world_tip_m2), 2) -
                                  std::pow(median_sigma_m(trajectory.motion.cov_world_tip_m2), 2)));
  note_motion(object, tip, trajectory.metrics);
  note_noise(object, trajectory.metrics);
  trajectory.motion = std::move(tip);
  trajectory.object = std::move(object);
}

Recording recording_on_object(const Recording& recording, const TrajectoryResult& trajectory) {
  const ObjectMotion& object = trajectory.object.value();
  Recording out = recording;
  const auto latency_ns = static_cast<std::int64_t>(std::llround(1e9 * pose_latency_s(recording, trajectory)));
  out.tracker = {};
  for (std::size_t i = 0; i < recording.tracker.size(); ++i) {
    const std::int64_t taken_ns = recording.tracker.t_ns[i] - latency_ns;
    if (!object.is_seen(taken_ns)) continue;
    out.tracker.t_ns.push_back(recording.tracker.t_ns[i]);
    out.tracker.T_world_marker.push_back(object.at(taken_ns).T_world_object.inverse() *
                                         recording.tracker.T_world_marker[i]);
  }
  Eigen::Vector3d down = Eigen::Vector3d::Zero();
  for (const Pose& T_world_object : object.T_world_object)
    down += T_world_object.rotation.conjugate() * recording.info.gravity_world_mps2;
  if (down.norm() > 0.0) out.info.gravity_world_mps2 = recording.info.gravity_world_mps2.norm() * down.normalized();
  if (out.truth && out.truth->T_world_object.empty()) out.truth.reset();
  if (out.truth) {
    Truth& truth = *out.truth;
    for (std::size_t i = 0; i < truth.size(); ++i) {
      const Pose T_object_world = truth.T_world_object[i].inverse();
      truth.p_world_tip_m[i] = T_object_world * truth.p_world_tip_m[i];
      truth.q_world_marker[i] = (T_object_world.rotation * truth.q_world_marker[i]).normalized();
    }
    truth.T_world_object.clear();
  }
  out.info.bodies.clear();
  out.body_poses.clear();
  return out;
}

}  // namespace asperity
