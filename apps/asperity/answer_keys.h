#pragma once

#include <chrono>

#include "terminal_keys.h"

namespace asperity::app {

// The keys of a person at a terminal, at once; or the characters of a file or pipe, one when one is wanted, without its
// line breaks. kEnd when there are no more.
class AnswerKeys {
 public:
  static constexpr char kEnd = 4;  // as Ctrl-D

  // Throws UsageError for a terminal that another job has: to read from it would stop this one.
  AnswerKeys();

  bool is_terminal() const { return terminal_.active(); }
  // Waits at most `timeout`; 0: none came. From a file or pipe only where `wanted`.
  char read(std::chrono::milliseconds timeout, bool wanted);

 private:
  TerminalKeys terminal_;
  bool was_terminal_;
};

}  // namespace asperity::app
