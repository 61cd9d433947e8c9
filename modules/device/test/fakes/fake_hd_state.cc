#include "fake_hd_state.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <thread>

namespace fake::hd {

namespace {

constexpr const char* kFile = "FAKE_HD_STATE";

int open_file() {
  const char* const path = std::getenv(kFile);
  return path != nullptr ? ::open(path, O_RDWR | O_CLOEXEC) : -1;
}

struct Scheduler {
  std::atomic<bool> running{false};
  Callback callback = nullptr;
  void* user = nullptr;
  std::thread thread;
};

Scheduler& scheduler() {
  static Scheduler the_scheduler;
  return the_scheduler;
}

int s_connection = -1;

struct flock whole_file() {
  struct flock out {};
  out.l_type = F_WRLCK;
  out.l_whence = SEEK_SET;
  return out;
}

void run_scheduler() {
  auto next = std::chrono::steady_clock::now();
  while (true) {
    next += std::chrono::milliseconds(1);
    std::this_thread::sleep_until(next);
    Callback callback = nullptr;
    {
      const Lock lock;
      if (!scheduler().running) return;
      if (state().stalled || state().mute) continue;
      callback = scheduler().callback;
    }
    if (callback != nullptr && callback(scheduler().user) == 0) {
      const Lock lock;
      scheduler().callback = nullptr;
    }
    const Lock lock;
    state().ramp_ticks += 1.0;
    state().hand.step(state().motor_N);
  }
}

}  // namespace

State& state() {
  static State* const mapped = []() -> State* {
    const int file = open_file();
    if (file < 0) return static_cast<State*>(std::calloc(1, sizeof(State)));
    const bool sized = ::ftruncate(file, sizeof(State)) == 0;
    void* const at = sized ? ::mmap(nullptr, sizeof(State), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0) : MAP_FAILED;
    ::close(file);
    if (at == MAP_FAILED) std::abort();
    return static_cast<State*>(at);
  }();
  return *mapped;
}

Lock::Lock() {
  if (::pthread_mutex_lock(&state().mutex) == EOWNERDEAD) ::pthread_mutex_consistent(&state().mutex);
}

void connect() {
  s_connection = open_file();
  struct flock lock = whole_file();
  if (s_connection >= 0) ::fcntl(s_connection, F_OFD_SETLK, &lock);
}

void disconnect() {
  if (s_connection >= 0) ::close(s_connection);
  s_connection = -1;
}

bool is_connected() {
  static const int file = open_file();
  struct flock lock = whole_file();
  if (file < 0 || s_connection >= 0) return true;
  return ::fcntl(file, F_OFD_GETLK, &lock) == 0 && lock.l_type != F_UNLCK;
}

void complain(unsigned code) {
  if (state().error_count < kMostErrors) state().errors[state().error_count++] = code;
}

bool usable() {
  if (!state().open) complain(kInvalidOperation);
  if (state().open && state().unplugged) complain(kCommError);
  return state().open && !state().unplugged;
}

void schedule(Callback callback, void* user) {
  scheduler().callback = callback;
  scheduler().user = user;
}

void start_scheduler() {
  if (scheduler().running) return;
  scheduler().running = true;
  scheduler().thread = std::thread(run_scheduler);
}

void stop_scheduler() {
  scheduler().running = false;
  if (scheduler().thread.joinable()) scheduler().thread.join();
}

}  // namespace fake::hd
