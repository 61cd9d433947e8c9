#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <limits>

#include <Eigen/Core>

#include "asperity/device/haptic_device.h"
#include "asperity/device/latest_value.h"
#include "hd_api.h"

namespace asperity::hd {

struct Command {
  Eigen::Vector3d force_N = Eigen::Vector3d::Zero();
  std::uint64_t sequence = 0;
};

// What the driver states of the device: DeviceInfo without memory of its own. Numbers that it does not state are nan.
struct Description {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  std::array<char, 256> model{};
  double rate_Hz = kNone;
  double max_force_N = kNone;
  double max_continuous_force_N = kNone;
  double max_stiffness_N_per_m = kNone;
  std::array<double, 3> workspace_min_m{kNone, kNone, kNone};
  std::array<double, 3> workspace_max_m{kNone, kNone, kNone};
};

// The driver's errors after which the device goes on.
inline constexpr std::array<unsigned, 4> kWarnings{kWarmMotors, kExceededMaxForce, kExceededMaxVelocity, kFrameError};

// The page that a program and the process of its driver share (asperity_openhaptics). Neither side waits for the other.
struct Mailbox {
  static constexpr std::uint32_t kVersion = 1;
  enum class State : std::uint32_t { kOpening, kOpen, kRefused };

  // The program's, before the process begins.
  std::uint32_t version = kVersion;
  std::array<char, 4096> library{};
  std::array<char, 256> device{};
  double rate_Hz = 1000.0;
  double force_timeout_s = 0.05;
  double hang_after_s = 0.1;

  // The process's: `description` is written before kOpen, `refusal` before kRefused.
  std::atomic<State> state{State::kOpening};
  Description description;
  std::array<char, 2048> refusal{};

  LatestValue<Command> commands;         // from the servo thread to the driver's
  LatestValue<DeviceReading> readings;   // back
  std::atomic<bool> ending{false};       // the force is zero from now on
  std::atomic<std::uint64_t> frames{0};  // that the driver's thread has ended
  std::atomic<std::uint64_t> readings_taken{0};
  std::atomic<std::uint64_t> silent_frames{0};  // ended with `ending` set
  std::atomic<bool> hung{false};                // the process ended itself since the driver did not return
  std::atomic<unsigned> fault_code{0}, other_code{0};
  std::array<std::atomic<bool>, kWarnings.size()> warned{};
};

static_assert(std::atomic<std::uint64_t>::is_always_lock_free && std::atomic<bool>::is_always_lock_free &&
              std::atomic<unsigned>::is_always_lock_free && std::atomic<Mailbox::State>::is_always_lock_free);

// The files that the process is started with.
inline constexpr int kMailboxFile = 3;
inline constexpr int kLineFile = 4;  // a socket; it closes with the program
inline constexpr char kClose = 'c';  // sent through it

}  // namespace asperity::hd
