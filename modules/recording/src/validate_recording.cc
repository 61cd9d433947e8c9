#include "asperity/recording/validate_recording.h"

#include <cmath>

#include <fmt/format.h>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "time_order.h"

namespace asperity {

namespace {

constexpr double kUnitTolerance = 1e-6;  // of a quaternion's length

[[noreturn]] void fail(const char* stream, std::size_t row, const char* what) {
  throw Error(fmt::format("recording: {} row {}: {}", stream, row, what));
}

void require_length(const char* stream, const char* what, std::size_t length, std::size_t expected) {
  if (length != expected) throw Error(fmt::format("recording: {}: {} {} for {} times", stream, length, what, expected));
}

void require_times(const char* stream, const std::vector<std::int64_t>& t_ns) {
  if (t_ns.empty()) throw Error(fmt::format("recording: {}: no rows", stream));
  for (std::size_t i = 0; i < t_ns.size(); ++i) {
    if (t_ns[i] < -kLatestTime_ns || t_ns[i] > kLatestTime_ns) fail(stream, i, "its time is out of range");
    if (i > 0 && t_ns[i] <= t_ns[i - 1]) fail(stream, i, "its time does not rise");
  }
}

void require_rotation(const char* stream, std::size_t row, const Eigen::Quaterniond& q) {
  if (!(std::abs(q.norm() - 1.0) <= kUnitTolerance)) fail(stream, row, "its quaternion is not of length one");
}

void require_tracker(const char* stream, const TrackerStream& tracker) {
  require_length(stream, "poses", tracker.T_world_marker.size(), tracker.size());
  if (!tracker.markers.empty()) require_length(stream, "marker counts", tracker.markers.size(), tracker.size());
  if (!tracker.reprojection_px.empty()) {
    require_length(stream, "reprojection errors", tracker.reprojection_px.size(), tracker.size());
  }
  if (!tracker.sigma_position_m.empty() || !tracker.sigma_rotation_rad.empty()) {
    require_length(stream, "standard deviations", tracker.sigma_position_m.size(), tracker.size());
    require_length(stream, "standard deviations", tracker.sigma_rotation_rad.size(), tracker.size());
  }
  if (!tracker.noise_position_m.empty() || !tracker.noise_rotation_rad.empty()) {
    require_length(stream, "standard deviations of one pose alone", tracker.noise_position_m.size(), tracker.size());
    require_length(stream, "standard deviations of one pose alone", tracker.noise_rotation_rad.size(), tracker.size());
  }
  for (std::size_t i = 0; i < tracker.size(); ++i) {
    if (!tracker.T_world_marker[i].translation_m.allFinite()) fail(stream, i, "its position is not finite");
    require_rotation(stream, i, tracker.T_world_marker[i].rotation);
  }
}

void require_bodies(const Recording& recording) {
  require_length("bodies", "streams of poses", recording.body_poses.size(), recording.info.bodies.size());
  if (recording.info.bodies.size() > kMostBodies)
    throw Error(fmt::format("recording: {} bodies, at most {}", recording.info.bodies.size(), kMostBodies));
  for (std::size_t i = 0; i < recording.body_poses.size(); ++i) {
    const std::string& name = recording.info.bodies[i].name;
    if (!is_body_name(name)) throw Error("recording: '" + printable(name) + "' is not a body's name");
    for (std::size_t k = 0; k < i; ++k) {
      if (recording.info.bodies[k].name == name) throw Error("recording: the body '" + name + "' is listed twice");
    }
    const std::string stream = "body " + name;
    if (recording.body_poses[i].size() > 0) require_times(stream.c_str(), recording.body_poses[i].t_ns);
    require_tracker(stream.c_str(), recording.body_poses[i]);
  }
}

void require_optional(const char* what, std::size_t length, std::size_t expected) {
  if (length != 0) require_length("probe", what, length, expected);
}

}  // namespace

void validate_recording(const Recording& recording) {
  const ProbeStream& probe = recording.probe;
  require_times("probe", probe.t_ns);
  require_length("probe", "accelerations", probe.accel_counts.size(), probe.size());
  require_length("probe", "forces", probe.force_counts.size(), probe.size());
  require_optional("gyro samples", probe.gyro_counts.size(), probe.size());
  require_optional("force3 samples", probe.force3_counts.size(), probe.size());
  for (std::size_t i = 0; i < probe.size(); ++i) {
    if (!probe.accel_counts[i].allFinite()) fail("probe", i, "its acceleration is not finite");
  }

  const TrackerStream& tracker = recording.tracker;
  require_times("tracker", tracker.t_ns);
  require_tracker("tracker", tracker);
  require_bodies(recording);

  const Eigen::Index width = recording.calibration.accelerometer.model == AccelerometerModel::kQuadric ? 9 : 3;
  if (recording.calibration.accelerometer.B.cols() != width || !recording.calibration.accelerometer.B.allFinite()) {
    throw Error(fmt::format("recording: calibration: accelerometer.B must be 3x{} and finite", width));
  }
  if (!recording.info.gravity_world_mps2.allFinite()) throw Error("recording: gravity_world_mps2 is not finite");

  if (!recording.truth) return;
  const Truth& truth = *recording.truth;
  require_times("truth", truth.t_ns);
  require_length("truth", "arc lengths", truth.s_m.size(), truth.size());
  require_length("truth", "heights", truth.height_m.size(), truth.size());
  require_length("truth", "positions", truth.p_world_tip_m.size(), truth.size());
  require_length("truth", "orientations", truth.q_world_marker.size(), truth.size());
  require_length("truth", "forces", truth.force_N.size(), truth.size());
  if (!truth.T_world_object.empty())
    require_length("truth", "poses of the object", truth.T_world_object.size(), truth.size());
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (!truth.p_world_tip_m[i].allFinite()) fail("truth", i, "its position is not finite");
    require_rotation("truth", i, truth.q_world_marker[i]);
    if (truth.T_world_object.empty()) continue;
    if (!truth.T_world_object[i].translation_m.allFinite()) fail("truth", i, "the object's position is not finite");
    require_rotation("truth", i, truth.T_world_object[i].rotation);
  }
}

}  // namespace asperity
