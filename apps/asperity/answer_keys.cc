#include "answer_keys.h"

#include <poll.h>
#include <unistd.h>

#include <thread>

namespace asperity::app {

AnswerKeys::AnswerKeys() : terminal_(true), was_terminal_(terminal_.active()) {}

char AnswerKeys::read(std::chrono::milliseconds timeout, bool wanted) {
  if (was_terminal_) {
    const char key = terminal_.read(timeout);
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
