#pragma once

#include <optional>
#include <string>
#include <vector>

#include "asperity/import/body_frame.h"
#include "asperity/import/stated_setting.h"

namespace asperity {

// Something about a group of columns that cannot be as it is read.
struct ImportDoubt {
  ColumnGroup group = ColumnGroup::kTime;
  FileRole role = FileRole::kPose;
  std::string message;                  // what is seen, and what it looks like
  std::string unit;                     // the unit that would fit; "" if it is not a unit
  std::vector<StatedSetting> settings;  // that would fit together; empty if it is not one
  std::string axes{};  // the group's columns that would fit as x, y, z, such as "y,-x,z"; "" if it is not these
  std::optional<bool> left_handed{};  // false: stating it no more would fit, too; true: it is to be stated before these
};

// How the streams were read, for what would fit better.
struct StreamUnits {
  std::string pose_time = "s", imu_time = "s", position = "m", acceleration = "m/s2", rate = "rad/s";
  Eigen::Matrix3d sensor_axes = Eigen::Matrix3d::Identity();
};

struct StreamChecks {
  std::vector<ImportDoubt> doubts;
  std::vector<std::string> notes;  // what could not be checked, and why
  double rest_mps2 = 0.0;          // length of the static specific force, or of its mean in the world; 0: neither
  double rate_ratio = 0.0;         // gyroscope over poses; 0: not determined
  double rate_cosine = 0.0;        // 1: both show the same rotation
  double rate_stretch_s = 0.0;     // over which both were averaged
  double pose_noise_rad = 0.0;     // white noise of a pose's rotation, RMS of the axes
  double scale = 0.0;              // positions over accelerometer; 0: not determined
};

// Times: the rate of the rows is between 2 Hz and 20 kHz for poses, 5 Hz and 60 kHz for the sensor, and no stream is
// longer than a day.
// Specific force: its length in the quietest 0.4 s, where it varies by less than 4 %, is 9.81 m/s² within 3 %; without
// such a stretch its mean in the world within 10 %. Rotation: both are averaged over 40 ms to 1.28 s (pair_rates.h),
// the shortest over which the poses' rotation has ten times the power of their white noise, whose share is taken off.
// Where the poses turn by more than 0.1 rad/s RMS (0.05 without the mean) and have three times the noise's power at
// least, the gyroscope's RMS agrees within 15 %, and the cosine Σ ω_p·ω_g / √(Σω_p² Σω_g²), without the means of both
// where 0.05 rad/s RMS remain, is above 0.8; both within two standard errors. If not, other orders of the quaternion,
// the inverse rotation, mirrored axes and the 24 exchanges of axes are tried, and a rotation fitted to the pairs
// (Kabsch 1976). A mirrored sensor is told from an exchanged one by the accelerometer. Poses that scatter by more than
// 0.1 rad from one to the next are not orientations. Lengths: where the acceleration is above 0.3 m/s² RMS, second
// differences of the positions over 0.1 s against the twice integrated specific force, regression slope within 0.5 to
// 2, or a cosine below 0.7 that other axes of the accelerometer or the positions raise above 0.9; and speeds below 20
// m/s. Poses and sensor must be on one clock. Streams that are empty are not checked.
StreamChecks check_streams(const ImportStreams& streams, const StreamUnits& units = {});

// The cosine of check_streams for rotations, at most 1 less two standard errors; 0 where it is not determined.
double rotation_cosine(const PoseStream& pose, const VectorStream& rate);

// The part on times alone.
StreamChecks check_times_only(const ImportStreams& streams, const StreamUnits& units = {});

// The world's axis that points up by the mean specific force, and its angle to it.
struct UpAxis {
  std::string name;  // "y", "-z"; the nearest
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();
  double angle_rad = 0.0;
};
std::optional<UpAxis> estimate_up(const ImportStreams& streams);

}  // namespace asperity
