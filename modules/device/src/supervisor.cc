#include "asperity/device/supervisor.h"

#include <fcntl.h>
#include <poll.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstring>
#include <ctime>
#include <new>
#include <string>

#include "asperity/base/error.h"

namespace asperity {

// A page that both processes see.
struct Supervisor::Shared {
  std::atomic<std::uint32_t> beats{0};     // of the host; 0: the watch has not begun
  std::atomic<std::uint32_t> rounds{0};    // of the child
  std::atomic<bool> farewell_said{false};  // by the child
};

std::int64_t boot_now_ns() noexcept {
  timespec now{};
  ::clock_gettime(CLOCK_BOOTTIME, &now);
  return std::int64_t{1'000'000'000} * now.tv_sec + now.tv_nsec;
}

namespace {

static_assert(std::atomic<std::uint32_t>::is_always_lock_free && std::atomic<bool>::is_always_lock_free);

constexpr char kDisarm = 'd';
constexpr int kPause_ms = 5;
constexpr int kWriteLimit_ms = 200;  // for a device that takes nothing
constexpr int kRound_ms = 10;        // between two looks at the beats
constexpr int kSayAgain_ms = 20;     // to a host that may wake up
constexpr int kChildPriority = 71;   // real-time: above the threads that it watches
constexpr std::int64_t kChildGone_ns = 2'000'000'000;

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

void say(int device_fd, const Farewell& farewell) {
  for (int k = 0; k < farewell.repeats; ++k) {
    write_all(device_fd, farewell);
    ::poll(nullptr, 0, kPause_ms);
  }
}

// What the pipe says within `wait_ms`.
enum class Host { kThere, kDone, kGone };
Host listen(int pipe, int wait_ms) {
  pollfd ready{.fd = pipe, .events = POLLIN, .revents = 0};
  if (::poll(&ready, 1, wait_ms) <= 0) return Host::kThere;
  char order = 0;
  const ssize_t count = ::read(pipe, &order, 1);
  if (count < 0 && errno == EINTR) return Host::kThere;
  return count == 1 && order == kDisarm ? Host::kDone : Host::kGone;
}

}  // namespace

void Supervisor::watch(Shared& shared, int pipe, int device_fd, std::span<const std::byte> bytes,
                       const SupervisorConfig& config) {
  Farewell farewell;
  std::copy(bytes.begin(), bytes.end(), farewell.bytes.begin());
  farewell.size = bytes.size();
  farewell.repeats = config.repeats;
  ::setsid();
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE, SIGTSTP}) ::signal(signal, SIG_IGN);
  keep_only(pipe, device_fd);
  // On a busy machine too it must be run in time; where that is not permitted it is run as others are.
  sched_param priority{};
  priority.sched_priority = kChildPriority;
  ::sched_setscheduler(0, SCHED_FIFO, &priority);
  const auto silence_ns = static_cast<std::int64_t>(config.silence_s * 1e9);
  std::uint32_t beats = 0;
  std::int64_t heard_ns = config.now_ns();
  for (;;) {
    const bool said = shared.farewell_said.load();
    const Host host = listen(pipe, said ? kSayAgain_ms : kRound_ms);
    if (host == Host::kDone) ::_exit(0);
    if (host == Host::kGone) {
      say(device_fd, farewell);
      ::_exit(0);
    }
    shared.rounds.fetch_add(1);
    const std::int64_t now_ns = config.now_ns();
    if (const std::uint32_t newest = shared.beats.load(); newest != beats) {
      beats = newest;
      heard_ns = now_ns;
    }
    if (said) {
      write_all(device_fd, farewell);
    } else if (beats != 0 && now_ns - heard_ns > silence_ns) {
      shared.farewell_said.store(true);  // first: who wakes up now must know
      say(device_fd, farewell);
    }
  }
}

Supervisor::Supervisor(int device_fd, std::span<const std::byte> farewell, const SupervisorConfig& config)
    : now_ns_(config.now_ns), silence_ns_(static_cast<std::int64_t>(config.silence_s * 1e9)) {
  if (farewell.empty() || farewell.size() > kMaxFarewell_bytes) {
    throw Error("supervisor: a farewell of " + std::to_string(farewell.size()) + " bytes; 1 to " +
                std::to_string(kMaxFarewell_bytes) + " are allowed");
  }
  void* const page =
      ::mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS | MAP_POPULATE, -1, 0);
  if (page == MAP_FAILED) throw Error(std::string("supervisor: no shared memory: ") + std::strerror(errno));
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) {
    const int error = errno;
    ::munmap(page, sizeof(Shared));
    throw Error(std::string("supervisor: no pipe: ") + std::strerror(error));
  }
  shared_ = new (page) Shared;
  heard_ns_ = now_ns_();
  child_ = ::fork();
  if (child_ == 0) {
    ::close(ends[1]);
    watch(*shared_, ends[0], device_fd, farewell, config);
  }
  const int error = errno;
  ::close(ends[0]);
  pipe_ = ends[1];
  if (child_ < 0) {
    ::close(pipe_);
    ::munmap(page, sizeof(Shared));
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
  ::munmap(shared_, sizeof(Shared));
}

bool Supervisor::beat() noexcept {
  if (over_) return false;
  const std::int64_t now_ns = now_ns_();
  const std::uint32_t rounds = shared_->rounds.load(std::memory_order_relaxed);
  if (rounds != rounds_seen_) {
    rounds_seen_ = rounds;
    heard_ns_ = now_ns;
  }
  const bool stood_still = begun_ && now_ns - beaten_ns_ > silence_ns_;  // or the machine was suspended
  begun_ = true;
  beaten_ns_ = now_ns;
  // 0 is "not begun", after 2^32 beats too.
  if (shared_->beats.fetch_add(1) == UINT32_MAX) shared_->beats.store(1);
  over_ = stood_still || shared_->farewell_said.load() || now_ns - heard_ns_ > kChildGone_ns;
  return !over_;
}

bool Supervisor::watching() {
  if (child_ > 0 && ::waitpid(child_, nullptr, WNOHANG) != 0) child_ = -1;
  return child_ > 0;
}

}  // namespace asperity
