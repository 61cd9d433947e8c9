#pragma once

#include <atomic>
#include <string>
#include <string_view>

namespace asperity {

// "interrupted; nothing was written", or what stays.
std::string interrupted_text();

// From now on SIGINT, SIGTERM, SIGHUP and SIGQUIT ask the program to stop: interrupted() turns true, and if the
// program has not ended within a second, unfinished output is removed, `say` is given interrupted_text(), and the
// process ends with 128 + signal. SIGTSTP, a terminal's Ctrl-Z, does so while a ForceHold lives; else it stops the
// process as ever. SIGPIPE and SIGXFSZ become errors of the write. Call once, before any other thread exists.
void watch_interrupts(void (*say)(std::string_view));

bool interrupted();

// While one lives, a hand may have force on it: the program is not ended by a signal, a second one either, before it
// is gone, for two seconds more at most.
class ForceHold {
 public:
  ForceHold();
  ~ForceHold();
  ForceHold(const ForceHold&) = delete;
  ForceHold& operator=(const ForceHold&) = delete;
};

// While one lives, something is being brought to its end: after the signal the program has a minute for that, and a
// second from its end on. A second signal ends it all the same.
class FinishHold {
 public:
  FinishHold();
  ~FinishHold();
  FinishHold(const FinishHold&) = delete;
  FinishHold& operator=(const FinishHold&) = delete;
};

// The command has ended and its code is known: a signal that came no longer changes it, however long the process takes
// to leave (a minute at most).
void command_ended();

// The same for those that watch a flag: turns true with interrupted(), and stays true.
const std::atomic<bool>& interrupt_flag();
// 128 + the signal that came, 130 for Ctrl-C.
int interrupt_exit_code();

}  // namespace asperity
