#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "asperity/device/haptic_device.h"
#include "asperity/render/servo_output.h"

namespace asperity {

// All that happened at one tick of the servo loop. Plain data.
struct ServoTick {
  std::int64_t t_ns = 0;  // of the schedule, from 0: the same in every run
  DeviceReading reading;
  Eigen::Vector3d p_world_m = Eigen::Vector3d::Zero();    // the device point in the scene
  ServoOutput output;                                     // what was rendered
  Eigen::Vector3d out_world_N = Eigen::Vector3d::Zero();  // what the safety layer let through
  std::uint32_t limited_by = 0;                           // SafetyCause flags
  double gain = 0.0;                                      // of its soft start and ramps to zero, within 0 and 1
  std::int64_t late_ns = 0;                               // start of the tick after its due time; 0 if not paced
  std::int64_t step_ns = 0;                               // duration of the render step; 0 if not timed
};

}  // namespace asperity
