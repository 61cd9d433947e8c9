#include "asperity/device/supervisor.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstring>
#include <string>

#include "asperity/base/error.h"

namespace asperity {
namespace {

constexpr char kDisarm = 'd';
constexpr int kPause_ms = 5;
constexpr int kWriteLimit_ms = 200;  // for a device that takes nothing

struct Farewell {
  std::array<std::byte, Supervisor::kMaxFarewell_bytes> bytes{};
  std::size_t size = 0;
  int repeats = 0;
};

// From here to _exit only calls that are allowed after a fork of a process with threads.

void write_all(int fd, const Farewell& farewell) {
  for (std::size_t done = 0; done < farewell.size;) {
    const ssize_t count = ::write(fd, farewell.bytes.data() + done, farewell.size - done);
    if (count >= 0) {
      done += static_cast<std::size_t>(count);
    } else if (errno == EAGAIN) {
      pollfd ready{.fd = fd, .events = POLLOUT, .revents = 0};
      if (::poll(&ready, 1, kWriteLimit_ms) <= 0) return;
    } else if (errno != EINTR) {
      return;
    }
  }
}

void keep_only(int a, int b) {
  const auto low = static_cast<unsigned>(std::min(a, b)), high = static_cast<unsigned>(std::max(a, b));
  if (low > 0) ::close_range(0, low - 1, 0);
  if (high > low + 1) ::close_range(low + 1, high - 1, 0);
  ::close_range(high + 1, UINT_MAX, 0);
}

[[noreturn]] void watch(int pipe, int device_fd, const Farewell& farewell) {
  ::setsid();
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE, SIGTSTP}) ::signal(signal, SIG_IGN);
  keep_only(pipe, device_fd);
  char order = 0;
  ssize_t count = 0;
  do {
    count = ::read(pipe, &order, 1);
  } while (count < 0 && errno == EINTR);
  if (count == 1 && order == kDisarm) ::_exit(0);
  for (int k = 0; k < farewell.repeats; ++k) {
    write_all(device_fd, farewell);
    ::poll(nullptr, 0, kPause_ms);
  }
  ::_exit(0);
}

}  // namespace

Supervisor::Supervisor(int device_fd, std::span<const std::byte> farewell, int repeats) {
  if (farewell.empty() || farewell.size() > kMaxFarewell_bytes) {
    throw Error("supervisor: a farewell of " + std::to_string(farewell.size()) + " bytes; 1 to " +
                std::to_string(kMaxFarewell_bytes) + " are allowed");
  }
  Farewell copy;
  std::copy(farewell.begin(), farewell.end(), copy.bytes.begin());
  copy.size = farewell.size();
  copy.repeats = repeats;
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw Error(std::string("supervisor: no pipe: ") + std::strerror(errno));
  child_ = ::fork();
  if (child_ == 0) {
    ::close(ends[1]);
    watch(ends[0], device_fd, copy);
  }
  const int error = errno;
  ::close(ends[0]);
  pipe_ = ends[1];
  if (child_ < 0) {
    ::close(pipe_);
    throw Error(std::string("supervisor: no process: ") + std::strerror(error));
  }
}

Supervisor::~Supervisor() {
  if (child_ > 0) {
    // The child may be gone: then the pipe is broken, and that must not end this process.
    struct sigaction ignore {
    }, before{};
    ignore.sa_handler = SIG_IGN;
    ::sigaction(SIGPIPE, &ignore, &before);
    while (::write(pipe_, &kDisarm, 1) < 0 && errno == EINTR) {
    }
    ::sigaction(SIGPIPE, &before, nullptr);
  }
  ::close(pipe_);
  if (child_ > 0) {
    while (::waitpid(child_, nullptr, 0) < 0 && errno == EINTR) {
    }
  }
}

bool Supervisor::watching() {
  if (child_ > 0 && ::waitpid(child_, nullptr, WNOHANG) != 0) child_ = -1;
  return child_ > 0;
}

}  // namespace asperity
