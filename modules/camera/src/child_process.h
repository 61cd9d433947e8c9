#pragma once

#include <sys/types.h>
#include <chrono>
#include <string>
#include <utility>
#include <vector>

namespace asperity {

// An open file that is closed with its owner.
class OwnedFile {
 public:
  explicit OwnedFile(int file = -1) noexcept : file_(file) {}
  ~OwnedFile();
  OwnedFile(OwnedFile&& other) noexcept : file_(std::exchange(other.file_, -1)) {}
  OwnedFile& operator=(OwnedFile&& other) noexcept;
  int get() const noexcept { return file_; }
  int release() noexcept { return std::exchange(file_, -1); }

 private:
  int file_;
};

// A pipe whose ends no other process inherits, {reading, writing}. Throws Error.
std::pair<OwnedFile, OwnedFile> make_pipe();

// Another program, started without a shell and found by PATH; killed and reaped with its owner.
class ChildProcess {
 public:
  // `files`: of ours and what the program sees it as; its standard input is empty. It gets no other file, signal's
  // handler or blocked signal of ours, and no signal of our terminal. Throws std::system_error with the errno of what
  // failed: ENOENT where there is no such program.
  ChildProcess(const std::vector<std::string>& arguments, const std::vector<std::pair<int, int>>& files);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  // Waits for its end and, when `most` is over, makes one; true if it ended by itself with 0.
  bool wait(std::chrono::milliseconds most);

 private:
  pid_t id_ = -1;
  bool good_ = false;
};

}  // namespace asperity
