#include "run_asperity.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <thread>

extern char** environ;

namespace asperity::cli {

namespace {

// The built program, or the one that ASPERITY_OTHER_PROGRAM names while ASPERITY_USE_OTHER is set.
std::string program() {
  const char* other = ::getenv("ASPERITY_OTHER_PROGRAM");
  return other != nullptr && ::getenv("ASPERITY_USE_OTHER") != nullptr ? other : ASPERITY_BINARY;
}

class Process {
 public:
  Process(const std::vector<std::string>& arguments, const std::string& out_path,
          const std::string& in_path = "/dev/null") {
    std::vector<char*> argv;
    std::vector<std::string> words{program()};
    words.insert(words.end(), arguments.begin(), arguments.end());
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    if (::pipe2(out_.data(), O_CLOEXEC) != 0 || ::pipe2(err_.data(), O_CLOEXEC) != 0) throw std::runtime_error("pipe");
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, 0, in_path.c_str(), O_RDONLY, 0);
    if (out_path.empty()) {
      posix_spawn_file_actions_adddup2(&actions, out_[1], 1);
    } else {
      posix_spawn_file_actions_addopen(&actions, 1, out_path.c_str(), O_WRONLY | O_CREAT, 0644);
    }
    posix_spawn_file_actions_adddup2(&actions, err_[1], 2);
    const int error = ::posix_spawn(&id_, words.front().c_str(), &actions, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    ::close(out_[1]);
    ::close(err_[1]);
    if (error != 0) throw std::runtime_error("cannot start " + words.front());
  }

  void send(int signal) const { ::kill(id_, signal); }
  pid_t pid() const { return id_; }

  Outcome wait() {
    Outcome outcome;
    std::array<pollfd, 2> files{{{out_[0], POLLIN, 0}, {err_[0], POLLIN, 0}}};
    std::array<std::string*, 2> texts{&outcome.out, &outcome.err};
    for (int open = 2; open > 0;) {
      ::poll(files.data(), files.size(), -1);
      for (std::size_t i = 0; i < files.size(); ++i) {
        if (files[i].fd < 0 || files[i].revents == 0) continue;
        std::array<char, 4096> buffer;
        const ssize_t count = ::read(files[i].fd, buffer.data(), buffer.size());
        if (count > 0) {
          texts[i]->append(buffer.data(), static_cast<std::size_t>(count));
        } else {
          ::close(files[i].fd);
          files[i].fd = -1;
          --open;
        }
      }
    }
    int status = 0;
    ::waitpid(id_, &status, 0);
    outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return outcome;
  }

 private:
  pid_t id_ = 0;
  std::array<int, 2> out_{};
  std::array<int, 2> err_{};
};

// Until the process has a handler for the signal, or waits for it: on a busy machine it takes a second to load. 30 s at
// most.
void wait_until_caught(pid_t process, int signal) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  while (std::chrono::steady_clock::now() < end) {
    std::ifstream status("/proc/" + std::to_string(process) + "/status");
    for (std::string line; std::getline(status, line);) {
      if ((line.starts_with("SigCgt:") || line.starts_with("SigBlk:")) &&
          (std::stoull(line.substr(7), nullptr, 16) >> (signal - 1) & 1U) != 0)
        return;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

}  // namespace

Outcome run_from(const std::filesystem::path& in, const std::vector<std::string>& arguments) {
  return Process(arguments, {}, in.string()).wait();
}

Outcome run(const std::vector<std::string>& arguments) { return Process(arguments, "").wait(); }

Outcome run_and_signal(const std::vector<std::string>& arguments, int signal, std::chrono::milliseconds delay) {
  Process process(arguments, "");
  if (signal != SIGKILL) wait_until_caught(process.pid(), signal);
  std::this_thread::sleep_for(delay);
  process.send(signal);
  return process.wait();
}

Outcome run_and_meddle(const std::vector<std::string>& arguments, const std::function<void(pid_t)>& meddle,
                       const std::filesystem::path& out) {
  Process process(arguments, out.string());
  meddle(process.pid());
  return process.wait();
}

Outcome run_into(const std::filesystem::path& path, const std::vector<std::string>& arguments) {
  return Process(arguments, path.string()).wait();
}

std::vector<std::pair<std::string, std::string>> contents(const std::filesystem::path& folder) {
  std::vector<std::pair<std::string, std::string>> out;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const std::string name = std::filesystem::relative(entry.path(), folder).string();
    if (!entry.is_regular_file()) {
      out.emplace_back(name + "/", "");
      continue;
    }
    std::ifstream file(entry.path(), std::ios::binary);
    out.emplace_back(name, std::string(std::istreambuf_iterator<char>(file), {}));
  }
  std::sort(out.begin(), out.end());
  return out;
}

void write_text(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

}  // namespace asperity::cli
