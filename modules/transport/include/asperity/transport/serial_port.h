#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "asperity/transport/byte_source.h"

namespace asperity {

struct SerialPortConfig {
  std::string path;           // "/dev/ttyUSB0", or a pseudo-terminal's
  int baud = 115200;          // bits per second
  std::string name;           // what messages call it: "serial:/dev/ttyUSB0"
  std::string device = "it";  // what is behind it, for messages: "the probe"
};

// A serial port, raw, 8 data bits, no parity, 1 stop bit, no flow control. Nobody else may have it meanwhile: it is
// locked (flock) and marked exclusive (TIOCEXCL). Its settings are not touched before it is ours, and what came or
// waited to go before that is forgotten. One thread at a time.
class SerialPort {
 public:
  using Clock = std::chrono::steady_clock;

  // Throws Error naming the port and what to do: absent, not permitted (dialout), in use (by whom), not a terminal, a
  // baud rate that there is not.
  explicit SerialPort(const SerialPortConfig& config);
  ~SerialPort();
  SerialPort(const SerialPort&) = delete;
  SerialPort& operator=(const SerialPort&) = delete;

  // What there is, at most `into`, as soon as something is there; 0 at `until`. Throws LinkLost when the port is
  // unplugged or the other side of a pseudo-terminal is closed.
  std::size_t read(std::span<std::uint8_t> into, Clock::time_point until);

  // How many of the first bytes were taken at once. Throws LinkLost.
  std::size_t write_some(std::span<const std::uint8_t> bytes);

  // All of it, or Error if it was not taken by then. Throws LinkLost.
  void write(std::span<const std::uint8_t> bytes, Clock::time_point until);

  // What has come and was not read is forgotten.
  void flush_input() noexcept;

  int descriptor() const noexcept;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace asperity
