#pragma once

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "asperity/base/error.h"

extern char** environ;

namespace asperity {

// A process that we started, with what /proc tells of it. Killed at the end if it still runs.
class WatchedProcess {
 public:
  WatchedProcess(std::string name, std::vector<std::string> words, const std::filesystem::path& output)
      : name_(std::move(name)) {
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, 1, output.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    posix_spawn_file_actions_adddup2(&actions, 1, 2);
    const int error = ::posix_spawn(&id_, words.front().c_str(), &actions, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (error != 0) throw Error("cannot start " + words.front());
  }
  WatchedProcess(const WatchedProcess&) = delete;
  WatchedProcess& operator=(const WatchedProcess&) = delete;
  ~WatchedProcess() {
    if (!ended_) ::kill(id_, SIGKILL);
    wait(5.0);
  }

  const std::string& name() const { return name_; }
  void send(int signal) const { ::kill(id_, signal); }
  // Its exit code, 128 + signal, or -1 while it runs.
  int wait(double limit_s) {
    for (const auto start = std::chrono::steady_clock::now(); !ended_;) {
      int status = 0;
      if (::waitpid(id_, &status, WNOHANG) == id_) {
        ended_ = true;
        code_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
      } else if (std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() >= limit_s) {
        return -1;
      } else {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
      }
    }
    return code_;
  }

  struct Reading {
    double memory_MiB = 0.0;
    int descriptors = 0, threads = 0;
  };
  Reading read() const {
    const std::filesystem::path proc = "/proc/" + std::to_string(id_);
    Reading out;
    std::ifstream status(proc / "status");
    for (std::string line; std::getline(status, line);) {
      if (line.starts_with("VmRSS:")) out.memory_MiB = std::stod(line.substr(6)) / 1024.0;
      if (line.starts_with("Threads:")) out.threads = std::stoi(line.substr(8));
    }
    for ([[maybe_unused]] const auto& file : std::filesystem::directory_iterator(proc / "fd")) ++out.descriptors;
    return out;
  }

 private:
  std::string name_;
  pid_t id_ = 0;
  bool ended_ = false;
  int code_ = -1;
};

}  // namespace asperity
