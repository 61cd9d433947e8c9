#pragma once

#include <array>
#include <memory>
#include <string>
#include <string_view>

#include "asperity/device/haptic_device.h"

namespace asperity {

// The orientation of the plane of a 2diy. Its own x runs from motor 1 to motor 2, its y from the motors to the tip.
enum class TwoDiyPlane {
  kTable,    // flat, the motors away from the user: x right, y toward the user
  kUpright,  // standing, the motors above: x right, y down
};
inline constexpr std::array<std::string_view, 2> kTwoDiyPlaneNames{"table", "upright"};

struct TwoDiyConfig {
  std::string port;         // "/dev/ttyACM0"; there is no default: other things are serial ports too
  int device_id = 5;        // that the board calls its mechanism
  bool directions = false;  // the board expects a direction after the motors and encoders (firmware of hAPI 2.2)
  TwoDiyPlane plane = TwoDiyPlane::kTable;
  bool mirror_x = false;  // x runs from motor 2 to motor 1
  double proximal_m = 0.05;
  double distal_m = 0.07;
  double base_m = 0.02;  // between the motors
  double encoder_counts = 13824.0;
  std::array<double, 2> offset_deg{180.0, 0.0};  // the arms' angles while the board is opened
  double max_torque_N_m = 0.25;                  // of a motor; ours, the maker states none
  double rate_Hz = 1000.0;                       // of questions to the board
  double force_timeout_s = 0.05;
  double late_after_s = 0.01;  // an answer this old is not new
  double stall_after_s = 0.02;
  double lost_after_s = 1.0;
  template <class V>
  void visit(V& v) {
    v.field("port", port, "serial port of the board");
    v.field("device_id", device_id, "number of the mechanism at the board", {0, 255});
    v.field("directions", directions, "the firmware accepts directions of motors and encoders");
    v.choice("plane", plane, kTwoDiyPlaneNames, "orientation of the device");
    v.field("mirror_x", mirror_x, "x runs from motor 2 to motor 1");
    v.field("proximal_m", proximal_m, "arm from a motor to its elbow, m", {0.005, 1.0});
    v.field("distal_m", distal_m, "arm from an elbow to the tip, m", {0.005, 1.0});
    v.field("base_m", base_m, "between the motors, m", {0.0, 1.0});
    v.field("encoder_counts", encoder_counts, "per rotation", {100.0, 1e9});
    v.field("offset_deg", offset_deg, "angles of the arms while it is opened, degrees", {-360.0, 360.0});
    v.field("max_torque_N_m", max_torque_N_m, "of a motor, N m", {0.001, 10.0});
    v.field("rate_Hz", rate_Hz, "questions to the board, Hz", {50.0, 4000.0});
    v.field("force_timeout_s", force_timeout_s, "older forces become zero, s", {0.001, 1.0});
    v.field("late_after_s", late_after_s, "a later answer is not used, s", {0.001, 1.0});
    v.field("stall_after_s", stall_after_s, "without an answer: stalled, s", {0.001, 1.0});
    v.field("lost_after_s", lost_after_s, "without an answer: a fault, s", {0.01, 60.0});
  }
};

// A Haply 2diy with a board of hAPI's version 2: a pantograph, two encoders, two motors, a serial port that is locked
// while this lives. A planar device: the force square to its plane is dropped. A thread of the device's own asks the
// board; each question carries the torques τ = Jᵀ f, scaled down together where one is over max_torque_N_m. Where the
// distal arms are nearly in line, torques are zero and the position is the last one. Velocity is estimated.
//
// The board holds the last torque for ever. Torques are zero after force_timeout_s without a write, on a fault and at
// close(), which also resets the board; a second process (supervisor.h) zeroes them should this one be killed, or stand
// still for 0.1 s: that is a fault for good.
//
// kStalled after stall_after_s without an answer; kFault, for good: port gone, wrong answers, lost_after_s without
// any. Throws Error: config out of range, no such port, not a terminal, in use, no answer within a second.
std::unique_ptr<HapticDevice> open_two_diy(const TwoDiyConfig& config);

}  // namespace asperity
