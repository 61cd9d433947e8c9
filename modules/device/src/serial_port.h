#pragma once

#include <chrono>
#include <cstddef>
#include <span>
#include <string>

namespace asperity {

// A serial port, raw, 115200 baud, locked against others (TIOCEXCL, and flock for those whom that does not stop).
// Throws Error in words throughout.
class SerialPort {
 public:
  using Clock = std::chrono::steady_clock;

  explicit SerialPort(const std::string& path);
  ~SerialPort();
  SerialPort(const SerialPort&) = delete;
  SerialPort& operator=(const SerialPort&) = delete;

  // All of it, or Error if it was not taken by then.
  void write(std::span<const unsigned char> bytes, Clock::time_point until);

  // What there is, at most `bytes`; 0 at `until`.
  std::size_t read(std::span<unsigned char> bytes, Clock::time_point until);

  int descriptor() const noexcept { return file_; }

  // What has come and was not read is forgotten.
  void flush_input() noexcept;

 private:
  void wait(short events, Clock::time_point until);
  [[noreturn]] void fail(const std::string& what, int reason) const;

  std::string path_;
  int file_ = -1;
};

}  // namespace asperity
