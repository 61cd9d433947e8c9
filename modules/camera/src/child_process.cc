#include "child_process.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <system_error>
#include <thread>

#include <spawn.h>

#include "asperity/base/error.h"

namespace asperity {

namespace {

// Above those that a program sees, so that no copying of one to its place overwrites another.
constexpr int kLowestOfOurs = 20;

OwnedFile out_of_the_way(int file) {
  OwnedFile out(::fcntl(file, F_DUPFD_CLOEXEC, kLowestOfOurs));
  const int reason = errno;
  ::close(file);
  if (out.get() < 0) throw Error(std::string("no more files can be opened: ") + std::strerror(reason));
  return out;
}

class SpawnPlan {
 public:
  SpawnPlan() {
    posix_spawn_file_actions_init(&files);
    posix_spawnattr_init(&attributes);
  }
  ~SpawnPlan() {
    posix_spawn_file_actions_destroy(&files);
    posix_spawnattr_destroy(&attributes);
  }
  SpawnPlan(const SpawnPlan&) = delete;
  SpawnPlan& operator=(const SpawnPlan&) = delete;

  posix_spawn_file_actions_t files;
  posix_spawnattr_t attributes;
};

}  // namespace

OwnedFile::~OwnedFile() {
  if (file_ >= 0) ::close(file_);
}

OwnedFile& OwnedFile::operator=(OwnedFile&& other) noexcept {
  std::swap(file_, other.file_);
  return *this;
}

std::pair<OwnedFile, OwnedFile> make_pipe() {
  int ends[2] = {-1, -1};
  if (::pipe2(ends, O_CLOEXEC) != 0) throw Error(std::string("no more pipes can be opened: ") + std::strerror(errno));
  OwnedFile reading(ends[0]);
  return {std::move(reading), out_of_the_way(ends[1])};
}

ChildProcess::ChildProcess(const std::vector<std::string>& arguments, const std::vector<std::pair<int, int>>& files) {
  SpawnPlan plan;
  posix_spawn_file_actions_addopen(&plan.files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  for (const auto& [ours, theirs] : files) posix_spawn_file_actions_adddup2(&plan.files, ours, theirs);
  sigset_t none, all;
  sigemptyset(&none);
  sigfillset(&all);
  posix_spawnattr_setsigmask(&plan.attributes, &none);
  posix_spawnattr_setsigdefault(&plan.attributes, &all);
  posix_spawnattr_setpgroup(&plan.attributes, 0);
  posix_spawnattr_setflags(&plan.attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
  std::vector<char*> words;
  for (const std::string& argument : arguments) words.push_back(const_cast<char*>(argument.c_str()));
  words.push_back(nullptr);
  const int reason = ::posix_spawnp(&id_, words.front(), &plan.files, &plan.attributes, words.data(), environ);
  if (reason != 0) {
    id_ = -1;
    throw std::system_error(reason, std::generic_category());
  }
}

ChildProcess::~ChildProcess() { wait(std::chrono::milliseconds(0)); }

bool ChildProcess::wait(std::chrono::milliseconds most) {
  const auto until = std::chrono::steady_clock::now() + most;
  while (id_ >= 0) {
    const bool late = std::chrono::steady_clock::now() >= until;
    if (late) ::kill(id_, SIGKILL);
    int status = 0;
    const pid_t ended = ::waitpid(id_, &status, late ? 0 : WNOHANG);
    if (ended == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    if (ended == 0 || (ended < 0 && errno == EINTR)) continue;
    good_ = ended == id_ && WIFEXITED(status) && WEXITSTATUS(status) == 0;
    id_ = -1;
  }
  return good_;
}

}  // namespace asperity
