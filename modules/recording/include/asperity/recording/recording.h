#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "asperity/base/problem.h"
#include "asperity/geometry/pose.h"
#include "asperity/json/json.h"
#include "asperity/recording/calibration.h"
#include "asperity/recording/recorder_state.h"
#include "asperity/recording/recording_origin.h"
#include "asperity/recording/tracked_body.h"

namespace asperity {

// Raw counts as the probe sent them, one entry a row. A sensor slower than the rows has nan where it
// has no new sample, but for the accelerometer: reading fills its rows by straight lines. gyro and force3 are empty, or
// as long as t_ns.
struct ProbeStream {
  std::vector<std::int64_t> t_ns;
  std::vector<Eigen::Vector3d> accel_counts;
  std::vector<double> force_counts;
  std::vector<Eigen::Vector3d> gyro_counts;
  std::vector<Eigen::Vector3d> force3_counts;

  std::size_t size() const { return t_ns.size(); }
  bool has_gyro() const { return !gyro_counts.empty(); }
};

// Poses of the marker body, one for each frame in which it was seen.
struct TrackerStream {
  std::vector<std::int64_t> t_ns;  // as received: the latency is still in it
  std::vector<Pose> T_world_marker;
  std::vector<int> markers;             // empty, or tags seen
  std::vector<double> reprojection_px;  // empty, or RMS residual
  // Empty, or standard deviations of translation and rotation vector along the world's axes; nan: unknown.
  std::vector<Eigen::Vector3d> sigma_position_m;
  std::vector<Eigen::Vector3d> sigma_rotation_rad;
  // Empty, or the part of them that is of one pose alone, without what the camera's and the markers' calibration makes
  // wrong in all; nan: unknown, take the whole.
  std::vector<Eigen::Vector3d> noise_position_m;
  std::vector<Eigen::Vector3d> noise_rotation_rad;

  std::size_t size() const { return t_ns.size(); }
};

// What a simulation knows (truth.csv).
struct Truth {
  std::vector<std::int64_t> t_ns;
  std::vector<double> s_m;       // arc length along the base surface (erratum 23)
  std::vector<double> height_m;  // of the tip along the base surface's normal
  std::vector<Eigen::Vector3d> p_world_tip_m;
  std::vector<Eigen::Quaterniond> q_world_marker;
  std::vector<double> force_N;            // contact force
  std::vector<Pose> T_world_object = {};  // empty: there is no body `object`

  std::size_t size() const { return t_ns.size(); }
};

// recording.json
struct RecordingInfo {
  std::string created = "1970-01-01T00:00:00Z";
  std::string object;
  std::string world = "camera";  // or "z_up"
  std::string probe_model = "open";
  double probe_rate_Hz = 0.0;  // nominal
  double adc_min = 0.0;
  double adc_max = 0.0;
  double tracker_rate_Hz = 0.0;     // nominal
  std::vector<TrackedBody> bodies;  // tracked in addition to the probe's
  Eigen::Vector3d gravity_world_mps2{0.0, 9.80665, 0.0};
  std::vector<Segment> segments;
  std::map<std::string, std::int64_t> problems;  // what the recorder lost or repaired
  std::optional<RecorderState> recorder;         // extra.recorder: a recorder of ours has made it
  bool has_force_sensor = true;                  // extra.force_sensor; false for motion that was imported
  std::optional<Pose> T_mesh_world;              // extra.T_mesh_world, of a simulation over a mesh, as it states it
  std::optional<SimulationOrigin> simulation;    // extra.simulation: not a measurement
  std::optional<ImportOrigin> imported;          // extra.imported
  bool is_replayed = false;                      // extra.replayed: another recording was played into the recorder
  Json extra = Json::object();                   // what others have put into extra
};

struct Recording {
  RecordingInfo info;
  ProbeStream probe;
  TrackerStream tracker;
  std::vector<TrackerStream> body_poses;  // one for each of info.bodies, T_world_body; empty if it was never seen
  Calibration calibration;
  std::optional<Truth> truth;
  Problems problems;  // what reading found damaged and repaired or left out

  // The poses of a body by its name; nullptr: it was not tracked.
  const TrackerStream* poses_of(std::string_view body) const;
};

}  // namespace asperity
