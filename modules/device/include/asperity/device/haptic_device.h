#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>

#include <Eigen/Core>

namespace asperity {

// What is known of a device before it moves. Numbers that its maker does not state are nan.
struct DeviceInfo {
  std::string name;   // "haply", "openhaptics", …
  std::string model;  // as the device calls itself
  double max_force_N = std::numeric_limits<double>::quiet_NaN();
  double max_continuous_force_N = std::numeric_limits<double>::quiet_NaN();
  double max_stiffness_N_per_m = std::numeric_limits<double>::quiet_NaN();
  double max_speed_mps = std::numeric_limits<double>::quiet_NaN();  // of the hand; nan: the config's
  double bandwidth_Hz = std::numeric_limits<double>::quiet_NaN();   // up to which it renders textures faithfully
  double rate_Hz = 1000.0;                                          // at which it wants to be served
  Eigen::Vector3d workspace_min_m = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  Eigen::Vector3d workspace_max_m = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  bool simulated = false;  // its hand is computed: it may be served faster than real time
  bool yields = true;      // its position answers to the force; false: a recorded path
};

enum class DeviceStatus : std::uint8_t {
  kReady,
  kStalled,  // no news for longer than the device may take; the sequence states at which reading it stopped
  kFault,    // gone, or it reports an error; it takes no force any more
  kEnded,    // nothing more will come: a replayed path is at its end, or the device was closed
};

// The state of a device at one tick, in the device's own axes (right x, up y, toward the user z).
struct DeviceReading {
  Eigen::Vector3d p_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d v_mps = Eigen::Vector3d::Zero();
  std::uint64_t sequence = 0;  // grows with each new reading of the hardware
  std::uint32_t buttons = 0;
  DeviceStatus status = DeviceStatus::kReady;
};

// A haptic device that is open. Its destructor commands zero force and closes it.
// read() and write() are called by the servo thread alone, one after another once a tick: they neither allocate,
// lock, throw nor wait; slow devices have their own thread and a mailbox behind them.
class HapticDevice {
 public:
  virtual ~HapticDevice() = default;

  virtual const DeviceInfo& info() const noexcept = 0;

  // The state at the tick `t_ns` of the servo's schedule, which begins at 0.
  virtual DeviceReading read(std::int64_t t_ns) noexcept = 0;

  // The force on the hand until the next write, in the device's axes. Devices whose force lasts only for a while
  // fall back to zero by themselves if it is not renewed.
  virtual void write(const Eigen::Vector3d& force_N) noexcept = 0;

  // Zero force, and no other from now on. Does not throw; may wait.
  virtual void close() noexcept = 0;

  // What went wrong, in words; empty if nothing did. After kFault its cause; a device that continues may have warnings
  // here (warm motors). Not for the servo thread.
  virtual std::string fault() const = 0;

 protected:
  HapticDevice() = default;
  HapticDevice(const HapticDevice&) = default;
  HapticDevice& operator=(const HapticDevice&) = default;
};

}  // namespace asperity
