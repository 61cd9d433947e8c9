#pragma once

#include <array>
#include <string>
#include <string_view>

namespace asperity {

// How the columns of one file are read.
struct FileMapping {
  std::string columns;
  std::string preset;
  std::string section;
  std::string body;
  double rate_Hz = 0.0;

  template <class V>
  void visit(V& v) {
    v.field("columns", columns, "what the columns mean, such as t=Timestamp[ms], px=X[mm]; empty: guessed");
    v.field("preset", preset, "whose file it is (motive, tum, …); empty: by its content, none: no one's");
    v.field("section", section, "the line above the table, where a file has several");
    v.field("body", body, "the body's name, where a file has several");
    v.field("rate_Hz", rate_Hz, "rate of the rows of a file without times, Hz; 0: as the file states it", {0.0, 1e7});
  }
};

enum class EulerAxes { kIntrinsic, kExtrinsic };
inline constexpr std::array<std::string_view, 2> kEulerAxesNames{"intrinsic", "extrinsic"};

enum class ClockChoice { kAuto, kOne, kSeparate };
inline constexpr std::array<std::string_view, 3> kClockChoiceNames{"auto", "one", "separate"};

// How tables become streams of one body.
struct MappingConfig {
  FileMapping pose, imu, gyro, force;
  std::string columns;
  std::string euler;
  EulerAxes euler_axes = EulerAxes::kIntrinsic;
  std::string quaternion = "xyzw";
  bool invert_rotation = false;
  std::string up;
  bool left_handed = false;
  std::string imu_axes = "x,y,z";
  std::array<double, 3> tip_m{0.0, 0.0, 0.0};
  ClockChoice clocks = ClockChoice::kAuto;

  template <class V>
  void visit(V& v) {
    v.field("columns", columns, "what columns of any of the files mean");
    v.field("euler", euler, "the order of the Euler angles: xyz, zyx, …");
    v.choice("euler_axes", euler_axes, kEulerAxesNames, "whether each angle is about the rotated or the fixed axis");
    v.field("quaternion", quaternion, "the order in a range of columns, wxyz or xyzw");
    v.field("invert_rotation", invert_rotation, "the rotations are from the world to the body");
    v.field("up", up, "the world's axis that points up: x, y, z, -x, -y, -z; empty: by the specific force");
    v.field("left_handed", left_handed, "the world's and the body's axes are left-handed");
    v.field("imu_axes", imu_axes, "the sensor's axes that are the body's x, y, z, such as y,-x,z");
    v.field("tip_m", tip_m, "the tip in the body's axes, m", {-10.0, 10.0});
    v.choice(
        "clocks", clocks, kClockChoiceNames,
        "one: the files have one clock; separate: offset and drift are estimated; auto: where times do not overlap");
    v.group("pose", pose);
    v.group("imu", imu);
    v.group("gyro", gyro);
    v.group("force", force);
  }
};

}  // namespace asperity
