#pragma once

#include <termios.h>

#include <chrono>

namespace asperity::app {

// Single keys from standard input while it is a terminal; its settings are put back when the object goes.
class TerminalKeys {
 public:
  explicit TerminalKeys(bool wanted);
  ~TerminalKeys();
  TerminalKeys(const TerminalKeys&) = delete;
  TerminalKeys& operator=(const TerminalKeys&) = delete;

  bool active() const { return active_; }
  // Waits at most `timeout` for a key; 0 if none came. Without a terminal it waits all the same.
  char read(std::chrono::milliseconds timeout);

 private:
  bool active_ = false;
  termios before_{};
};

}  // namespace asperity::app
