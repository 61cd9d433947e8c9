#pragma once

#include <cstdint>

#include "asperity/device/haptic_device.h"
#include "hd_api.h"
#include "hd_mailbox.h"

namespace asperity::hd {

// Serves a device of OpenHaptics' driver by a mailbox: the driver's scheduler calls once a frame, which takes the
// newest force and leaves the newest reading. A force that is not renewed for the mailbox's `force_timeout_s`
// (CLOCK_BOOTTIME) ends in that call. The library stays loaded: the driver does not survive that it is not.
class Server {
 public:
  // Opens the device, enables its force with the driver's ramping and clamping, and waits for the first reading. Throws
  // Error naming the libraries searched for, or the driver's error in words.
  explicit Server(Mailbox& mailbox);
  ~Server() { close(); }
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  // Two frames without force, then the driver's end. May wait.
  void close() noexcept;

 private:
  static unsigned on_frame(void* self) { return static_cast<Server*>(self)->frame(); }

  unsigned drain_first_error() noexcept;
  double limit(unsigned parameter) noexcept;
  void describe();
  void start();
  unsigned frame() noexcept;
  bool is_driven(const Command& command, std::int64_t now_ns) noexcept;
  bool note_errors() noexcept;

  Mailbox& mailbox_;
  Api api_;
  unsigned handle_ = kInvalidHandle;
  unsigned long schedule_ = 0;
  bool scheduled_ = false;
  bool closed_ = false;

  // The driver's thread's.
  bool begun_ = false;
  DeviceReading reading_;
  std::uint64_t taken_ = 0;
  std::int64_t renewed_ns_ = 0;
  double gain_ = 0.0;
  double gain_step_ = 1.0;
};

}  // namespace asperity::hd
