#include "asperity/studio/open_browser.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>
#include <csignal>

#include <cstdlib>
#include <exception>
#include <thread>

namespace asperity::studio {

namespace {

bool is_set(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr && *value != '\0';
}

// A new file for the user alone; empty without a folder.
std::filesystem::path private_file(const std::string& text) {
  const std::filesystem::path folder = is_set("XDG_RUNTIME_DIR") ? std::filesystem::path(std::getenv("XDG_RUNTIME_DIR"))
                                                                 : std::filesystem::temp_directory_path();
  const std::string suffix = ".html";
  std::string name = (folder / ("asperity-studio-XXXXXX" + suffix)).string();
  const int file = mkostemps(name.data(), static_cast<int>(suffix.size()), O_CLOEXEC);
  if (file < 0) return {};
  const bool whole = write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  close(file);
  if (whole) return name;
  unlink(name.c_str());
  return {};
}

// Without a shell, without a word on our terminal, and out of reach of its Ctrl-C.
void spawn_program(const char* program, const std::string& argument) {
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  for (const int output : {STDOUT_FILENO, STDERR_FILENO}) {
    posix_spawn_file_actions_addopen(&files, output, "/dev/null", O_WRONLY, 0);
  }
  // The studio's port, connections and sensors are not the browser's, which may outlive it.
  posix_spawn_file_actions_addclosefrom_np(&files, STDERR_FILENO + 1);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t none;
  sigemptyset(&none);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setpgroup(&attributes, 0);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETPGROUP);
  std::string name = program, only = argument;
  char* const arguments[] = {name.data(), only.data(), nullptr};
  pid_t child = 0;
  if (posix_spawnp(&child, program, &files, &attributes, arguments, environ) == 0) {
    std::thread([child] { waitpid(child, nullptr, 0); }).detach();
  }
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&files);
}

}  // namespace

OpenedBrowser::OpenedBrowser(const std::string& address) noexcept {
  try {
    if (!is_set("DISPLAY") && !is_set("WAYLAND_DISPLAY")) return;
    file_ = private_file(
        "<!doctype html><meta charset=\"utf-8\"><meta name=\"referrer\" content=\"no-referrer\">"
        "<title>Asperity</title><meta http-equiv=\"refresh\" content=\"0; url=" +
        address + "\"><a href=\"" + address + "\">Asperity's studio</a>\n");
    if (!file_.empty()) spawn_program("xdg-open", file_.string());
  } catch (const std::exception&) {
    // The address was printed all the same.
  }
}

OpenedBrowser::~OpenedBrowser() {
  std::error_code ignored;
  if (!file_.empty()) std::filesystem::remove(file_, ignored);
}

}  // namespace asperity::studio
