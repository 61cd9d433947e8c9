#include "answer_keys.h"

#include <poll.h>
#include <unistd.h>

#include <csignal>
#include <thread>

#include "command.h"

namespace asperity::app {

namespace {

constexpr char kEscape = 0x1b;

}  // namespace

AnswerKeys::AnswerKeys() : terminal_(true), was_terminal_(terminal_.active()) {
  // A job in the background would be stopped by reading its terminal, with force on a hand.
  if (::isatty(STDIN_FILENO) == 1 && !was_terminal_) {
    throw UsageError("the keys come from a terminal that another job has: run it in the foreground");
  }
  ::signal(SIGTTIN, SIG_IGN);
}

char AnswerKeys::read(std::chrono::milliseconds timeout, bool wanted) {
  if (was_terminal_) {
    const char key = terminal_.read(timeout);
    // Arrows and function keys are sequences, whose bytes are no answers.
    if (key == kEscape) {
      while (terminal_.read(std::chrono::milliseconds(0)) != 0) {
      }
      return terminal_.active() ? '\0' : kEnd;
    }
    return terminal_.active() ? key : kEnd;
  }
  if (!wanted) {
    std::this_thread::sleep_for(timeout);
    return 0;
  }
  pollfd wait{STDIN_FILENO, POLLIN, 0};
  if (::poll(&wait, 1, static_cast<int>(timeout.count())) <= 0) return 0;
  char key = 0;
  if (::read(STDIN_FILENO, &key, 1) != 1) return kEnd;
  return key == '\n' || key == '\r' ? '\0' : key;
}

}  // namespace asperity::app
