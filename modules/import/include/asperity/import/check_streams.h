#pragma once

#include <optional>
#include <string>
#include <vector>

#include "asperity/import/body_frame.h"

namespace asperity {

// What the streams say of each other: one stretch after the other, rotations by the poses and by the gyroscope.
struct RatePairs {
  std::vector<Eigen::Vector3d> pose_radps;  // mean over the stretch, in the body's axes
  std::vector<Eigen::Vector3d> gyro_radps;
};

// Stretches of 40 ms, or two poses if those are further apart. `pose_ahead_ns` is added to the poses' times.
RatePairs pair_rates(const PoseStream& pose, const VectorStream& rate, std::int64_t pose_ahead_ns = 0);

// Something about a group of columns that cannot be as it is read.
struct ImportDoubt {
  ColumnGroup group = ColumnGroup::kTime;
  FileRole role = FileRole::kPose;
  std::string message;  // what is seen, and what it looks like
  std::string unit;     // the unit that would fit; "" if it is not a unit
  std::string setting;  // the option that would fit, such as "--imu-axes y,-x,z"; "" if it is not one
};

// How the streams were read, for what would fit better.
struct StreamUnits {
  std::string pose_time = "s", imu_time = "s", position = "m", acceleration = "m/s2", rate = "rad/s";
  Eigen::Matrix3d sensor_axes = Eigen::Matrix3d::Identity();
};

struct StreamChecks {
  std::vector<ImportDoubt> doubts;
  std::vector<std::string> notes;  // what could not be checked, and why
  double rest_mps2 = 0.0;          // length of the specific force at rest, or of its mean in the world; 0: neither
  double rate_ratio = 0.0;         // gyroscope over poses; 0: not determined
  double rate_cosine = 0.0;        // 1: both show the same rotation
  double scale = 0.0;              // positions over accelerometer; 0: not determined
};

// Times: the rate of the rows lies between 2 Hz and 20 kHz for poses, 5 Hz and 60 kHz for the sensor, and no stream is
// longer than a day.
// Specific force: its length in the quietest 0.4 s, where it varies by less than 4 %, is 9.81 m/s² within 3 %; without
// such a stretch its mean in the world within 10 %. Rotation: where the poses turn by more than 0.1 rad/s RMS, the
// gyroscope's RMS agrees within 15 %, and the cosine Σ ω_p·ω_g / √(Σω_p² Σω_g²) is above 0.8. If not, other orders of
// the quaternion, the inverse rotation, mirrored axes and the 24 exchanges of axes are tried, and a rotation fitted to
// the pairs (Kabsch 1976). Lengths: where the acceleration is above 0.3 m/s² RMS, second differences of the positions
// over 0.1 s against the twice integrated specific force, regression slope within 0.5 to 2; and speeds below 20 m/s.
// Poses and sensor must be on one clock. Streams that are empty are not checked.
StreamChecks check_streams(const ImportStreams& streams, const StreamUnits& units = {});

// The cosine of check_streams for rotations; 0 where the poses turn by less than 0.1 rad/s RMS or fewer than 20
// stretches are in both.
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
