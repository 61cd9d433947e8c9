#include "control_folder.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "asperity/base/error.h"
#include "asperity/base/text.h"

namespace asperity::studio {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

fs::path folder_path() {
  const char* runtime = std::getenv("XDG_RUNTIME_DIR");
  if (runtime != nullptr && *runtime == '/') return fs::path(runtime) / "asperity";
  return fs::temp_directory_path() / ("asperity-" + std::to_string(::geteuid()));
}

// True once `file` is ready for `event`; false after `until`, or when `stop` can be read.
bool wait_for(int file, short event, Clock::time_point until, int stop) {
  for (;;) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(until - Clock::now()).count();
    if (left < 0) return false;
    std::array<pollfd, 2> watched{{{file, event, 0}, {stop, POLLIN, 0}}};
    const int ready = ::poll(watched.data(), watched.size(), static_cast<int>(left) + 1);
    if (ready < 0 && errno != EINTR) return false;
    if (ready > 0) return watched[1].revents == 0;
  }
}

}  // namespace

int open_control_folder(bool make) {
  const fs::path path = folder_path();
  const std::string name = printable(path.string(), 200);
  if (make && ::mkdir(path.c_str(), 0700) != 0 && errno != EEXIST) {
    throw Error(name + ": cannot be made: " + std::strerror(errno));
  }
  const int folder = ::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (folder < 0 && !make && errno == ENOENT) return -1;
  if (folder < 0) throw Error(name + ": cannot be opened: " + std::strerror(errno));
  struct stat status {};
  if (::fstat(folder, &status) == 0 && status.st_uid == ::geteuid() && (status.st_mode & 077U) == 0) return folder;
  ::close(folder);
  throw Error(name + ": is not a folder of this user alone; remove it, or set XDG_RUNTIME_DIR");
}

bool is_own_user(int connection) {
  ucred peer{};
  socklen_t size = sizeof peer;
  return ::getsockopt(connection, SOL_SOCKET, SO_PEERCRED, &peer, &size) == 0 && peer.uid == ::geteuid();
}

std::optional<std::string> receive_line(int connection, std::size_t most, int stop) {
  const auto until = Clock::now() + kControlPatience;
  std::string out;
  while (out.find('\n') == std::string::npos) {
    if (out.size() > most || !wait_for(connection, POLLIN, until, stop)) return std::nullopt;
    std::array<char, 4096> piece{};
    const ssize_t got = ::recv(connection, piece.data(), piece.size(), MSG_DONTWAIT);
    if (got < 0 && (errno == EAGAIN || errno == EINTR)) continue;
    if (got <= 0) return std::nullopt;
    out.append(piece.data(), static_cast<std::size_t>(got));
  }
  out.resize(out.find('\n'));
  if (out.size() > most) return std::nullopt;
  return out;
}

bool send_all(int connection, std::string_view text) {
  const auto until = Clock::now() + kControlPatience;
  while (!text.empty()) {
    if (!wait_for(connection, POLLOUT, until, -1)) return false;
    const ssize_t sent = ::send(connection, text.data(), text.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent < 0 && (errno == EAGAIN || errno == EINTR)) continue;
    if (sent <= 0) return false;
    text.remove_prefix(static_cast<std::size_t>(sent));
  }
  return true;
}

}  // namespace asperity::studio
