#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include "asperity/base/units.h"
#include "asperity/recording/read_limits.h"
#include "asperity/recording/recording.h"

namespace asperity {

// Motion that others recorded: an inertial sensor and poses of the same body, on one clock. World
// z up; the sensor's axes are the body's.
struct ImportInput {
  std::vector<std::int64_t> imu_t_ns;
  std::vector<Eigen::Vector3d> specific_force_mps2;  // f = a − g
  std::vector<Eigen::Vector3d> rate_radps;
  std::vector<std::int64_t> pose_t_ns;
  std::vector<Pose> T_world_body;
  std::vector<std::int64_t> object_t_ns;  // empty: no second body was tracked
  std::vector<Pose> T_world_object;
  // What the 16-bit counts span.
  double accelerometer_range_mps2 = 16.0 * kStandardGravity_mps2;
  double gyroscope_range_radps = 2000.0 * std::numbers::pi / 180.0;
  // White noise of the poses as they come, along and about the world's axes; zero: as assumed. What ImportConfig states
  // goes before.
  Eigen::Vector3d sigma_position_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d sigma_rotation_rad = Eigen::Vector3d::Zero();
  Problems problems;  // what was left out when reading
};

// What a motion-capture system is good for where its noise is not stated and not estimated as larger.
inline constexpr double kAssumedPoseNoise_m = 5e-5;
inline constexpr double kAssumedPoseNoise_rad = 1e-3;

struct ImportConfig {
  double pose_rate_Hz = 0.0;
  std::array<double, 3> pose_noise_m{0.0, 0.0, 0.0};
  std::array<double, 3> rotation_noise_rad{0.0, 0.0, 0.0};
  double tracker_sigma_m = 0.0;
  double tracker_sigma_rad = 0.0;
  std::int64_t seed = 1;
  double gravity_mps2 = 9.81;
  double accelerometer_position_sigma_m = 0.05;
  double latency_sigma_s = 0.005;
  std::string object = "imported motion";

  template <class V>
  void visit(V& v) {
    v.field("pose_rate_Hz", pose_rate_Hz, "thin the poses to this rate, Hz; 0 keeps all", {0.0, 1e6});
    v.field("pose_noise_m", pose_noise_m, "noise added along the world's axes, standard deviation, m", {0.0, 1.0});
    v.field("rotation_noise_rad", rotation_noise_rad, "noise added about the world's axes, standard deviation, rad",
            {0.0, 1.0});
    v.field("tracker_sigma_m", tracker_sigma_m, "noise that the poses have already, each axis, m; 0: estimated",
            {0.0, 1.0});
    v.field("tracker_sigma_rad", tracker_sigma_rad, "the same of their rotation, rad; 0: estimated", {0.0, 1.0});
    v.field("seed", seed, "of the noise");
    v.field("gravity_mps2", gravity_mps2, "where it was recorded, m/s^2", {0.0, 30.0});
    v.field("accelerometer_position_sigma_m", accelerometer_position_sigma_m,
            "how far the sensor may sit from the tracked point, m", {0.0, 10.0});
    v.field("latency_sigma_s", latency_sigma_s, "how far the clocks may differ, s", {0.0, 10.0});
    v.field("object", object, "what the recording is called");
  }
};

// The inertial samples as counts of a 16-bit sensor of the stated ranges, the poses thinned to the
// rows nearest to a regular clock and given seeded Gaussian noise, and all poses as truth. The tip is
// the body's origin. Poses of an object become the body `object`, thinned and given noise likewise. There is no force:
// its column is 0 and extra.force_sensor false. Throws Error if a stream is empty or its vectors differ in length.
Recording import_imu_pose(const ImportInput& input, const ImportConfig& config);

// Reads `imu` (t_s,ax_mps2,ay_mps2,az_mps2,gx_radps,gy_radps,gz_radps) and `poses`
// (t_s,px_m,py_m,pz_m,qw,qx,qy,qz), and of `object_poses`, unless that is empty, likewise. Rows with nan are left out
// and counted. Throws Error with file and line.
ImportInput read_imu_pose(const std::filesystem::path& imu, const std::filesystem::path& poses,
                          const std::filesystem::path& object_poses = {}, const ReadLimits& limits = {});

// The same from text; each fills its part of `input`.
void parse_imu_csv(std::string_view text, const std::string& name, ImportInput& input, const ReadLimits& limits = {});
void parse_pose_csv(std::string_view text, const std::string& name, ImportInput& input, const ReadLimits& limits = {});
void parse_object_pose_csv(std::string_view text, const std::string& name, ImportInput& input,
                           const ReadLimits& limits = {});

}  // namespace asperity
