#pragma once

#include <functional>
#include <memory>
#include <ostream>
#include <string>

#include <gtest/gtest.h>
#include <Eigen/Core>

#include "asperity/device/haptic_device.h"

namespace asperity::testing_devices {

// A device back-end over its fake. The fake's hand is pulled by kPull_N along −y and is damped, with a time constant
// on the wall that is long beside a servo tick; it starts in free space with at least 5 mm to fall.
// For a new device: derive from this, and in a test file of its own
//   INSTANTIATE_TEST_SUITE_P(Haply, DeviceConformance, testing::Values(ConformanceCase{"haply", make_haply_rig}),
//                            case_name);
class DeviceRig {
 public:
  virtual ~DeviceRig() = default;

  // Opens the back-end onto the fake, which outlives it. Throws what the back-end throws.
  virtual std::unique_ptr<HapticDevice> open() = 0;

  // What the motors (or the voice coil) are driven with now, as the fake has it: device axes for a device with a
  // force, the level in x for a vibrating one, in any unit.
  virtual Eigen::Vector3d motor_output() = 0;

  virtual bool has_position() const { return true; }  // else it only vibrates: the wall is left out
  virtual bool exclusive() const { return true; }     // a second open() throws while the first is open
  virtual bool real_time() const { return true; }     // the test sleeps a millisecond between ticks
  virtual bool can_unplug() const { return true; }
  virtual bool can_stall() const { return true; }
  // The greatest time from the stall to kStalled, of the schedule.
  virtual double stalled_within_s() const { return 0.5; }

  virtual void unplug() {}  // the cable is pulled: every call of the driver fails from now on
  virtual void stall() {}   // the driver neither fails nor says anything new

  static constexpr double kPull_N = 1.0;
};

struct ConformanceCase {
  std::string name;
  std::function<std::unique_ptr<DeviceRig>()> make;
};

inline std::ostream& operator<<(std::ostream& out, const ConformanceCase& value) { return out << value.name; }

inline std::string case_name(const testing::TestParamInfo<ConformanceCase>& info) { return info.param.name; }

class DeviceConformance : public testing::TestWithParam<ConformanceCase> {
 protected:
  void SetUp() override { rig_ = GetParam().make(); }

  // One tick: reads, writes the force that `law` gives for the reading, and goes on by a millisecond.
  DeviceReading tick(HapticDevice& device, const std::function<Eigen::Vector3d(const DeviceReading&)>& law);

  // Ticks under `law` until `done` says so of a reading; false after `limit_s` of the schedule.
  bool tick_until(HapticDevice& device, double limit_s, const std::function<Eigen::Vector3d(const DeviceReading&)>& law,
                  const std::function<bool(const DeviceReading&)>& done);

  // Waits until the motors' output is zero; false after ten seconds.
  bool motors_become_silent();

  std::unique_ptr<DeviceRig> rig_;
  std::int64_t t_ns_ = 0;
};

}  // namespace asperity::testing_devices
