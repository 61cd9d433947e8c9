#pragma once

#include <sys/types.h>

#include <chrono>
#include <string>

namespace asperity {

// A process of ours that runs a maker's driver: the program `name`, found as own_library_paths() says. It has a session
// of its own (Ctrl-C and Ctrl-Z do not reach it), every signal as a new process has it, and of this process's files
// those that are not closed by exec, standard error, `page` as its file 3 and one end of a socket as its file 4, which
// closes with this process however it ends.
class DriverProcess {
 public:
  // Throws Error if it cannot be started, naming where it was looked for.
  DriverProcess(const std::string& name, int page);
  // Kills it if it still runs.
  ~DriverProcess();
  DriverProcess(const DriverProcess&) = delete;
  DriverProcess& operator=(const DriverProcess&) = delete;

  // True once it has ended; waits for that so long.
  bool has_ended(std::chrono::milliseconds wait) noexcept;
  // How it ended, in words; empty if it has not.
  const std::string& end() const noexcept { return end_; }

  void send(char order) noexcept;
  void kill() noexcept;

 private:
  pid_t child_ = -1;
  int line_ = -1;
  std::string end_;
};

}  // namespace asperity
