#pragma once

#include <sys/types.h>

#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include <Eigen/Core>

namespace asperity::cli {

// What can happen to a program that commands force, or to its device.
enum class FaultKind {
  kStop,
  kSuspend,
  kHang,
  kUnplug,
  kCut,
  kGlitch,
  kDuplicate,
  kGarbage,
  kLate,
  kSlow,
  kFast,
  kOutOfOrder,
  kKill,
  kDriverStopped,
  kDriverKilled,
};
inline constexpr std::array<std::string_view, 15> kFaultNames{"SIGSTOP",
                                                              "suspended (CLOCK_BOOTTIME jumps)",
                                                              "does not answer",
                                                              "unplugged",
                                                              "connection cut",
                                                              "glitch: 8 readings 30 mm off",
                                                              "each answer twice",
                                                              "garbage",
                                                              "60 ms late",
                                                              "15 ms late",
                                                              "four answers for one",
                                                              "out of order",
                                                              "SIGKILL",
                                                              "SIGSTOP to the driver's process",
                                                              "SIGKILL to the driver's process"};

// A device that is played: behind it a hand is pulled toward a block a little away.
class PlayedDevice {
 public:
  virtual ~PlayedDevice() = default;

  virtual std::string setting() const = 0;  // where it is: key=value
  virtual double force_N() const = 0;       // that it gives now
  // The corners of the block.
  Eigen::Vector3d low_m, high_m;

  // The fault begins. `clock_ahead` is the file that clock_shim.c reads.
  void begin(FaultKind kind, pid_t program, const std::filesystem::path& clock_ahead);

 private:
  virtual void trouble(FaultKind kind) = 0;  // of the device's own
};

// "2diy", "haply", "dhd" or "openhaptics", with the block `away_m` from the hand, which takes 40 ms for each mm.
std::unique_ptr<PlayedDevice> play_device(std::string_view name, double away_m);

// Of a block in metres, an OBJ file.
std::string block_obj(const Eigen::Vector3d& low_m, const Eigen::Vector3d& high_m);

}  // namespace asperity::cli
