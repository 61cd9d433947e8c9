#include "terminal_keys.h"

#include <poll.h>
#include <unistd.h>

#include <thread>

namespace asperity::app {

TerminalKeys::TerminalKeys(bool wanted) {
  // A job in the background is stopped if it touches its terminal.
  if (!wanted || ::isatty(STDIN_FILENO) != 1 || ::tcgetpgrp(STDIN_FILENO) != ::getpgrp()) return;
  if (::tcgetattr(STDIN_FILENO, &before_) != 0) return;
  termios raw = before_;
  raw.c_lflag &= static_cast<tcflag_t>(~(ICANON | ECHO));
  raw.c_cc[VMIN] = 0;
  raw.c_cc[VTIME] = 0;
  active_ = ::tcsetattr(STDIN_FILENO, TCSANOW, &raw) == 0;
}

TerminalKeys::~TerminalKeys() {
  if (active_) ::tcsetattr(STDIN_FILENO, TCSANOW, &before_);
}

char TerminalKeys::read(std::chrono::milliseconds timeout) {
  if (!active_) {
    std::this_thread::sleep_for(timeout);
    return 0;
  }
  pollfd wait{STDIN_FILENO, POLLIN, 0};
  if (::poll(&wait, 1, static_cast<int>(timeout.count())) <= 0) return 0;
  char key = 0;
  if (::read(STDIN_FILENO, &key, 1) == 1) return key;
  active_ = false;  // the terminal is gone
  return 0;
}

}  // namespace asperity::app
