#pragma once

#include <sys/types.h>
#include <cstddef>
#include <cstdint>
#include <span>

namespace asperity {

// CLOCK_BOOTTIME, ns: unlike host_now_ns() it continues while the machine is suspended. Realtime-safe: yes.
std::int64_t boot_now_ns() noexcept;

struct SupervisorConfig {
  int repeats = 3;         // of the farewell, 5 ms apart: its first copy may complete a frame that was cut off
  double silence_s = 0.1;  // without a beat for so long, the farewell is written
  std::int64_t (*now_ns)() noexcept = &boot_now_ns;  // another one for tests; called in the child too
};

// A second process that ends a device's force if this one is killed, stopped, suspended or hangs: for devices that hold
// the last force they were sent and have no time-out of their own. It waits at a pipe whose other end this process
// holds. If that end closes, however this process came to its end (SIGKILL and crashes among them), it writes
// `farewell` to `device_fd`. Once beat() has been called, it does so too when no beat has come for `silence_s`
// (SIGSTOP, a debugger, a call that hangs, a suspended machine); beat() says so from then on, and the farewell is
// written again every 20 ms until this process ends or disarms it: what a process sends that wakes up does not last.
//
//   Supervisor supervisor(serial_fd, zero_torque_frame);   // after opening the device
//   while (…) { if (!supervisor.beat()) throw Error(…); … }  // the thread that sends forces, before each
//   …                                                      // its destructor, after the last zero force, disarms it
//
// The child runs in a session of its own, ignores the signals of a terminal, holds no file but these two, and calls
// nothing but read, write, poll, clock_gettime and _exit; it may be started while other threads run.
class Supervisor {
 public:
  static constexpr std::size_t kMaxFarewell_bytes = 512;

  // Throws Error if the farewell is empty or too long or if no process can be started.
  Supervisor(int device_fd, std::span<const std::byte> farewell, const SupervisorConfig& config = {});
  // Disarms the child and waits for its end. Nothing is written.
  ~Supervisor();
  Supervisor(const Supervisor&) = delete;
  Supervisor& operator=(const Supervisor&) = delete;

  // "I am here." False, for good, if the silence was too long, or if the child has not been heard for 2 s: nobody
  // watches any more. Send no force then but zero. The first beat begins the watch. One thread. Realtime-safe: yes.
  bool beat() noexcept;

  // False if the child was ended by someone else; then nobody watches any more.
  bool watching();

 private:
  struct Shared;
  // The child's life. From there on only calls that are allowed after a fork of a process with threads.
  [[noreturn]] static void watch(Shared& shared, int pipe, int device_fd, std::span<const std::byte> farewell,
                                 const SupervisorConfig& config);

  Shared* shared_ = nullptr;  // mapped in both processes
  std::int64_t (*now_ns_)() noexcept = nullptr;
  std::int64_t silence_ns_ = 0;
  bool begun_ = false;
  std::int64_t beaten_ns_ = 0;
  std::uint32_t rounds_seen_ = 0;
  std::int64_t heard_ns_ = 0;
  bool over_ = false;
  int pipe_ = -1;
  pid_t child_ = -1;
};

}  // namespace asperity
