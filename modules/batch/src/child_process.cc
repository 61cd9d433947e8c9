#include "child_process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <optional>
#include <system_error>
#include <thread>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/base/output.h"
#include "asperity/base/text.h"

namespace asperity {

namespace fs = std::filesystem;

namespace {

constexpr auto kLook = std::chrono::milliseconds(5);
constexpr auto kPatience = std::chrono::seconds(3);
constexpr std::uint64_t kLargestText_bytes = 256ULL << 20;

// A new file for a child to write to, closed at the end.
class ChildFile {
 public:
  explicit ChildFile(const fs::path& path) : path_(path) {
    file_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (file_ < 0) throw Error(path.string() + ": cannot be written: " + std::strerror(errno));
  }
  ~ChildFile() { ::close(file_); }
  ChildFile(const ChildFile&) = delete;
  ChildFile& operator=(const ChildFile&) = delete;
  int file() const { return file_; }
  std::string content() const { return read_file(path_, kLargestText_bytes); }

 private:
  fs::path path_;
  int file_ = -1;
};

class SpawnActions {
 public:
  SpawnActions() { ::posix_spawn_file_actions_init(&actions_); }
  ~SpawnActions() { ::posix_spawn_file_actions_destroy(&actions_); }
  SpawnActions(const SpawnActions&) = delete;
  SpawnActions& operator=(const SpawnActions&) = delete;
  posix_spawn_file_actions_t* get() { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_{};
};

pid_t start(const ChildCommand& command, int output, int log) {
  SpawnActions actions;
  ::posix_spawn_file_actions_addopen(actions.get(), STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  ::posix_spawn_file_actions_adddup2(actions.get(), output, STDOUT_FILENO);
  ::posix_spawn_file_actions_adddup2(actions.get(), log, STDERR_FILENO);
  const fs::path folder = command.folder.empty() ? fs::path(".") : command.folder;
  ::posix_spawn_file_actions_addchdir_np(actions.get(), folder.c_str());
  std::string name = command.program.string();
  std::vector<std::string> words = command.words;
  std::vector<char*> pointers{name.data()};
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  pid_t child = 0;
  const int error = ::posix_spawn(&child, command.program.c_str(), actions.get(), nullptr, pointers.data(), environ);
  if (error != 0) throw Error(name + ": cannot be started: " + std::strerror(error));
  return child;
}

// The child's exit, or nullopt if it still runs.
std::optional<int> exit_of(pid_t child) {
  int status = 0;
  const pid_t ended = ::waitpid(child, &status, WNOHANG);
  if (ended == 0 || (ended < 0 && errno == EINTR)) return std::nullopt;
  if (ended < 0) throw Error(std::string("a step's process was lost: ") + std::strerror(errno));
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

void stop(pid_t child) {
  ::kill(child, SIGTERM);
  const auto end = std::chrono::steady_clock::now() + kPatience;
  while (!exit_of(child)) {
    if (std::chrono::steady_clock::now() > end) ::kill(child, SIGKILL);
    std::this_thread::sleep_for(kLook);
  }
}

// The last line that is not empty, without the program's name before it.
std::string last_line(std::string_view text) {
  const std::size_t last = text.find_last_not_of(" \t\r\n");
  if (last == std::string_view::npos) return "";
  text = text.substr(0, last + 1);
  text = text.substr(text.find_last_of('\n') + 1);
  constexpr std::string_view kProgram = "asperity: ";
  if (text.starts_with(kProgram)) text.remove_prefix(kProgram.size());
  return printable(text, 500);
}

}  // namespace

ChildResult run_child(const ChildCommand& command, const Observer& observer) {
  ChildResult out;
  fs::path captured = command.output;
  if (!captured.empty()) captured += ".new";
  {
    const ChildFile log(command.log);
    std::optional<ChildFile> output;
    if (!captured.empty()) output.emplace(captured);
    const pid_t child = start(command, output ? output->file() : log.file(), log.file());
    std::optional<int> ended;
    while (!(ended = exit_of(child))) {
      if (observer.cancelled && observer.cancelled()) {
        stop(child);
        std::error_code ignored;
        fs::remove(captured, ignored);
        throw Cancelled();
      }
      std::this_thread::sleep_for(kLook);
    }
    out.exit_code = *ended;
    out.last_error_line = last_line(log.content());
    if (output && (out.exit_code == 0 || out.exit_code == 3)) write_file(command.output, output->content());
  }
  if (!captured.empty()) {
    std::error_code ignored;
    fs::remove(captured, ignored);
  }
  return out;
}

}  // namespace asperity
