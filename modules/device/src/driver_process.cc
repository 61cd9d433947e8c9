#include "driver_process.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>

#include "asperity/base/error.h"
#include "asperity/base/load_library.h"
#include "asperity/base/text.h"

extern char** environ;

namespace asperity {

namespace {

constexpr int kFirstFree = 10;  // above the files that the process is given

struct SpawnPlan {
  posix_spawn_file_actions_t files;
  posix_spawnattr_t attributes;
  SpawnPlan() {
    ::posix_spawn_file_actions_init(&files);
    ::posix_spawnattr_init(&attributes);
  }
  ~SpawnPlan() {
    ::posix_spawn_file_actions_destroy(&files);
    ::posix_spawnattr_destroy(&attributes);
  }
  SpawnPlan(const SpawnPlan&) = delete;
  SpawnPlan& operator=(const SpawnPlan&) = delete;
};

std::string how_it_ended(int status) {
  if (WIFSIGNALED(status)) return "by signal " + std::to_string(WTERMSIG(status));
  return "with code " + std::to_string(WEXITSTATUS(status));
}

}  // namespace

DriverProcess::DriverProcess(const std::string& name, int page) {
  std::string tried, path;
  for (const std::string& candidate : own_library_paths(name)) {
    if (path.empty() && ::access(candidate.c_str(), X_OK) == 0) path = candidate;
    tried += "\n  " + printable(candidate, 300);
  }
  if (path.empty()) throw Error("the program of the driver's process was not found; searched for:" + tried);
  std::array<int, 2> line{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, line.data()) != 0) {
    throw Error(std::string("no line to the driver's process: ") + std::strerror(errno));
  }
  line_ = line[0];
  const int theirs = ::fcntl(line[1], F_DUPFD_CLOEXEC, kFirstFree), copy = ::fcntl(page, F_DUPFD_CLOEXEC, kFirstFree);
  SpawnPlan plan;
  ::posix_spawn_file_actions_addopen(&plan.files, 0, "/dev/null", O_RDONLY, 0);
  ::posix_spawn_file_actions_adddup2(&plan.files, 2, 1);  // what a driver prints is not the program's result
  ::posix_spawn_file_actions_adddup2(&plan.files, copy, 3);
  ::posix_spawn_file_actions_adddup2(&plan.files, theirs, 4);
  sigset_t none, all;
  ::sigemptyset(&none);
  ::sigfillset(&all);
  ::posix_spawnattr_setsigmask(&plan.attributes, &none);
  ::posix_spawnattr_setsigdefault(&plan.attributes, &all);
  ::posix_spawnattr_setflags(&plan.attributes, POSIX_SPAWN_SETSID | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  std::array<char*, 2> words{path.data(), nullptr};
  const int error = ::posix_spawn(&child_, path.c_str(), &plan.files, &plan.attributes, words.data(), environ);
  for (const int file : {line[1], theirs, copy}) ::close(file);
  if (error == 0) return;
  ::close(line_);
  throw Error("the driver's process cannot be started: " + printable(path, 300) + ": " + std::strerror(error));
}

DriverProcess::~DriverProcess() {
  if (!has_ended(std::chrono::milliseconds(0))) {
    kill();
    while (::waitpid(child_, nullptr, 0) < 0 && errno == EINTR) {
    }
  }
  ::close(line_);
}

bool DriverProcess::has_ended(std::chrono::milliseconds wait) noexcept {
  if (!end_.empty()) return true;
  // Its end of the line closes with it.
  pollfd ready{.fd = line_, .events = POLLIN, .revents = 0};
  ::poll(&ready, 1, static_cast<int>(wait.count()));
  int status = 0;
  const pid_t ended = ::waitpid(child_, &status, WNOHANG);
  if (ended == 0 || (ended < 0 && errno == EINTR)) return false;
  end_ = ended > 0 ? how_it_ended(status) : "without a trace";
  return true;
}

void DriverProcess::send(char order) noexcept {
  while (::send(line_, &order, 1, MSG_NOSIGNAL) < 0 && errno == EINTR) {
  }
}

void DriverProcess::kill() noexcept {
  if (end_.empty()) ::kill(child_, SIGKILL);
}

}  // namespace asperity
