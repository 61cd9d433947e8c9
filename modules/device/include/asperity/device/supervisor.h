#pragma once

#include <sys/types.h>
#include <cstddef>
#include <span>

namespace asperity {

// A second process that ends a device's force if this one is killed: for devices that hold the last force they were
// sent and have no time-out of their own. It waits at a pipe whose other end this process holds. If that end closes,
// however this process came to its end (SIGKILL and crashes among them), it writes `farewell` to `device_fd`.
//
//   Supervisor supervisor(serial_fd, zero_torque_frame);   // after opening the device
//   …                                                      // its destructor, after the last zero force, disarms it
//
// The child runs in a session of its own, ignores the signals of a terminal, holds no file but these two, and calls
// nothing but read, write, poll and _exit; it may be started while other threads run.
class Supervisor {
 public:
  static constexpr std::size_t kMaxFarewell_bytes = 256;

  // The farewell is written `repeats` times, 5 ms apart: its first copy may complete a frame that was cut off.
  // Throws Error if the farewell is empty or too long or if no process can be started.
  Supervisor(int device_fd, std::span<const std::byte> farewell, int repeats = 3);
  // Disarms the child and waits for its end. Nothing is written.
  ~Supervisor();
  Supervisor(const Supervisor&) = delete;
  Supervisor& operator=(const Supervisor&) = delete;

  // False if the child was ended by someone else; then nobody watches any more.
  bool watching();

 private:
  int pipe_ = -1;
  pid_t child_ = -1;
};

}  // namespace asperity
