#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "asperity/base/progress.h"

namespace asperity {

struct ChildCommand {
  std::filesystem::path program;
  std::vector<std::string> words;
  std::filesystem::path folder;  // where it runs
  std::filesystem::path output;  // standard output as a file, written as a whole when it exits with 0 or 3; empty: log
  std::filesystem::path log;     // standard error, and output if it has no file of its own
};

struct ChildResult {
  int exit_code = -1;  // or 128 + the signal that ended it
  std::string last_error_line;
};

// Runs it to its end, with no input. Throws Cancelled when the observer says so, after the child was asked to end
// (SIGTERM) and has, or was killed 3 s later; Error if it cannot be started or a file cannot be written. To be called
// by any number of threads.
ChildResult run_child(const ChildCommand& command, const Observer& observer);

}  // namespace asperity
