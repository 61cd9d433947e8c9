// A stand-in for OpenHaptics' libHD.so: the symbols and the behaviour that we rely on, over a simulated device.
#include <fcntl.h>
#include <pthread.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <thread>

#include "damped_mass.h"

namespace {

struct ErrorInfo {
  unsigned code;
  int internal_code;
  unsigned device;
};

constexpr unsigned kHandle = 7;
constexpr unsigned kInvalidHandle = 0xFFFFFFFF;
constexpr unsigned kInvalidEnum = 0x100, kInvalidOperation = 0x102, kDeviceFault = 0x300, kCommError = 0x302;
constexpr unsigned kAlreadyInitiated = 0x301, kExceededMaxForce = 0x201, kFrameError = 0x402;
constexpr double kMaxForce_N = 3.3;
constexpr double kRamp_ticks = 50.0;
constexpr unsigned kMostErrors = 64;
constexpr int kGlitchReadings = 8;

// Of the device and the driver: in the file FAKE_HD_STATE, which the test and the process that has the driver loaded
// have mapped, or, without it, of this process alone. A process may be killed at any place, so the mutex is a robust
// one.
struct State {
  std::uint32_t begun;
  pthread_mutex_t mutex;
  fake::DampedMass hand;
  unsigned errors[kMostErrors];  // the newest is told first
  unsigned error_count;
  bool absent;
  bool unplugged;
  bool stalled;
  bool mute;   // the scheduler never calls
  bool hangs;  // a call does not return
  bool garbage;
  int glitches;  // readings 30 mm off that are to come
  bool open;
  pid_t process;  // that has it open
  bool in_frame;
  bool force_output, clamping, ramping;
  double wanted_N[3];  // set in the frame
  double motor_N[3];   // since its end
  double ramp_ticks;
  unsigned calls_out_of_order;
  unsigned long frames;
};

constexpr const char* kFile = "FAKE_HD_STATE";

int open_file() {
  const char* const path = std::getenv(kFile);
  return path != nullptr ? ::open(path, O_RDWR | O_CLOEXEC) : -1;
}

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

class Lock {
 public:
  Lock() {
    if (::pthread_mutex_lock(&state().mutex) == EOWNERDEAD) ::pthread_mutex_consistent(&state().mutex);
  }
  ~Lock() { ::pthread_mutex_unlock(&state().mutex); }
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;
};

// The driver's own thread, in the process that has it loaded.
struct Scheduler {
  std::atomic<bool> running{false};
  unsigned (*callback)(void*) = nullptr;
  void* user = nullptr;
  std::thread thread;
};

Scheduler& scheduler() {
  static Scheduler the_scheduler;
  return the_scheduler;
}

// The process that has the device open holds a lock on the file, which ends with it however it ends; as the device's
// connection does.
int s_connection = -1;

struct flock whole_file() {
  struct flock out {};
  out.l_type = F_WRLCK;
  out.l_whence = SEEK_SET;
  return out;
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

void schedule() {
  auto next = std::chrono::steady_clock::now();
  while (true) {
    next += std::chrono::milliseconds(1);
    std::this_thread::sleep_until(next);
    unsigned (*callback)(void*) = nullptr;
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

bool usable() {
  if (!state().open) complain(kInvalidOperation);
  if (state().open && state().unplugged) complain(kCommError);
  return state().open && !state().unplugged;
}

}  // namespace

// The vendor's names.
// NOLINTBEGIN(readability-identifier-naming)
extern "C" {

unsigned hdInitDevice(const char* name) {
  const Lock lock;
  const bool known = name == nullptr || std::strcmp(name, "Default Device") == 0;
  if (state().absent || !known) {
    complain(kDeviceFault);
    return kInvalidHandle;
  }
  if (state().open && is_connected()) {
    complain(kAlreadyInitiated);
    return kInvalidHandle;
  }
  connect();
  state().open = true;
  state().process = ::getpid();
  state().in_frame = false;
  return kHandle;
}

void hdDisableDevice(unsigned handle) {
  const Lock lock;
  if (handle != kHandle) return;
  state().open = false;
  disconnect();
}

void hdBeginFrame(unsigned handle) {
  const auto hangs = [] {
    const Lock lock;
    return state().hangs;
  };
  while (hangs()) ::usleep(1000);
  const Lock lock;
  if (!usable()) return;
  if (handle != kHandle || state().in_frame) {
    ++state().calls_out_of_order;
    return complain(kFrameError);
  }
  state().in_frame = true;
}

void hdEndFrame(unsigned handle) {
  const Lock lock;
  ++state().frames;
  if (!usable()) {
    state().in_frame = false;
    return;
  }
  if (handle != kHandle || !state().in_frame) {
    ++state().calls_out_of_order;
    return complain(kFrameError);
  }
  state().in_frame = false;
  if (!state().force_output) return;
  const double norm_N = std::hypot(state().wanted_N[0], state().wanted_N[1], state().wanted_N[2]);
  double scale = state().ramping ? std::min(1.0, state().ramp_ticks / kRamp_ticks) : 1.0;
  if (norm_N > kMaxForce_N) {
    scale *= state().clamping ? kMaxForce_N / norm_N : 0.0;
    if (!state().clamping) complain(kExceededMaxForce);
  }
  for (int i = 0; i < 3; ++i) state().motor_N[i] = scale * state().wanted_N[i];
}

ErrorInfo hdGetError() {
  const Lock lock;
  if (state().error_count == 0) return {0, 0, kHandle};
  const unsigned code = state().errors[--state().error_count];
  return {code, -1, kHandle};
}

void hdEnable(unsigned capability) {
  const Lock lock;
  if (!usable()) return;
  if (capability == 0x4000) {
    state().force_output = true;
    state().ramp_ticks = 0.0;
  } else if (capability == 0x4001) {
    state().clamping = true;
  } else if (capability == 0x4002) {
    state().ramping = true;
  } else {
    complain(kInvalidEnum);
  }
}

void hdDisable(unsigned capability) {
  const Lock lock;
  if (capability == 0x4000) state().force_output = false;
  if (capability == 0x4001) state().clamping = false;
  if (capability == 0x4002) state().ramping = false;
}

void hdGetDoublev(unsigned parameter, double* out) {
  const Lock lock;
  if (!usable()) return;
  const bool moving = parameter == 0x2050 || parameter == 0x2051;
  if (moving && !state().in_frame) {
    ++state().calls_out_of_order;
    return complain(kFrameError);
  }
  switch (parameter) {
    case 0x2050:
      for (int i = 0; i < 3; ++i) out[i] = 1e3 * state().hand.p_m[i];
      if (state().glitches > 0) {
        --state().glitches;
        out[1] -= 30.0;
      }
      if (state().garbage) out[1] = std::nan("");
      break;
    case 0x2051:
      for (int i = 0; i < 3; ++i) out[i] = 1e3 * state().hand.v_mps[i];
      break;
    case 0x2551: {
      const double box_mm[6] = {-210.0, -110.0, -85.0, 210.0, 205.0, 130.0};
      std::memcpy(out, box_mm, sizeof box_mm);
      break;
    }
    case 0x2602:
      *out = 0.5;
      break;
    case 0x2603:
      *out = kMaxForce_N;
      break;
    case 0x2604:
      *out = 0.88;
      break;
    default:
      complain(kInvalidEnum);
  }
}

void hdSetDoublev(unsigned parameter, const double* in) {
  const Lock lock;
  if (parameter != 0x2700) return complain(kInvalidEnum);
  // What is commanded is kept even if nobody is there to take it: tests look at it.
  for (int i = 0; i < 3; ++i) state().wanted_N[i] = in[i];
  if (!usable()) {
    for (int i = 0; i < 3; ++i) state().motor_N[i] = in[i];
    return;
  }
  if (!state().in_frame) {
    ++state().calls_out_of_order;
    complain(kFrameError);
  }
}

void hdGetIntegerv(unsigned parameter, int* out) {
  const Lock lock;
  if (!usable()) return;
  if (parameter == 0x2000) {
    if (!state().in_frame) {
      ++state().calls_out_of_order;
      return complain(kFrameError);
    }
    *out = 2;
  } else if (parameter == 0x2600) {
    *out = 1000;
  } else {
    complain(kInvalidEnum);
  }
}

const char* hdGetString(unsigned parameter) {
  const Lock lock;
  if (parameter == 0x2501) return "Fake Touch";
  complain(kInvalidEnum);
  return nullptr;
}

#ifndef FAKE_HD_INCOMPLETE
unsigned long hdScheduleAsynchronous(unsigned (*callback)(void*), void* user, unsigned short) {
  const Lock lock;
  scheduler().callback = callback;
  scheduler().user = user;
  return 11;
}
#endif

void hdStartScheduler() {
  const Lock lock;
  if (!usable() || scheduler().running) return;
  scheduler().running = true;
  scheduler().thread = std::thread(schedule);
}

void hdStopScheduler() {
  scheduler().running = false;
  if (scheduler().thread.joinable()) scheduler().thread.join();
}

void hdUnschedule(unsigned long) {
  const Lock lock;
  scheduler().callback = nullptr;
}

void hdSetSchedulerRate(unsigned long rate_Hz) {
  const Lock lock;
  if (rate_Hz != 1000) complain(0x101);
}

// For tests. At the first of them the file is new.
void fake_hd_reset() {
  State& s = state();
  if (s.begun == 0) {
    pthread_mutexattr_t kind;
    ::pthread_mutexattr_init(&kind);
    ::pthread_mutexattr_setpshared(&kind, PTHREAD_PROCESS_SHARED);
    ::pthread_mutexattr_setrobust(&kind, PTHREAD_MUTEX_ROBUST);
    ::pthread_mutex_init(&s.mutex, &kind);
    ::pthread_mutexattr_destroy(&kind);
    s.begun = 1;
  }
  hdStopScheduler();
  const Lock lock;
  s.hand = {};
  s.error_count = 0;
  s.absent = s.unplugged = s.stalled = s.mute = s.hangs = s.garbage = s.open = s.in_frame = false;
  s.glitches = 0;
  s.force_output = s.clamping = s.ramping = false;
  for (int i = 0; i < 3; ++i) s.wanted_N[i] = s.motor_N[i] = 0.0;
  s.ramp_ticks = 0.0;
  s.calls_out_of_order = 0;
  s.frames = 0;
  scheduler().callback = nullptr;
  disconnect();
}
void fake_hd_set(const char* what, int on) {
  const Lock lock;
  if (std::strcmp(what, "absent") == 0) state().absent = on != 0;
  if (std::strcmp(what, "unplugged") == 0) state().unplugged = on != 0;
  if (std::strcmp(what, "stalled") == 0) state().stalled = on != 0;
  if (std::strcmp(what, "mute") == 0) state().mute = on != 0;
  if (std::strcmp(what, "hangs") == 0) state().hangs = on != 0;
  if (std::strcmp(what, "garbage") == 0) state().garbage = on != 0;
  if (std::strcmp(what, "glitch") == 0) state().glitches = on != 0 ? kGlitchReadings : 0;
}
void fake_hd_complain(unsigned code) {
  const Lock lock;
  complain(code);
}
// As commanded; none once the process that has it open is gone.
void fake_hd_motor(double* out_N) {
  const Lock lock;
  std::memcpy(out_N, state().motor_N, sizeof state().motor_N);
  if (state().open && !is_connected()) std::fill(out_N, out_N + 3, 0.0);
}
void fake_hd_position(double* out_m) {
  const Lock lock;
  std::memcpy(out_m, state().hand.p_m, sizeof state().hand.p_m);
}
unsigned fake_hd_calls_out_of_order() {
  const Lock lock;
  return state().calls_out_of_order;
}
unsigned long fake_hd_frames() {
  const Lock lock;
  return state().frames;
}
int fake_hd_open() {
  const Lock lock;
  return state().open && is_connected() ? 1 : 0;
}
int fake_hd_process() {
  const Lock lock;
  return state().process;
}
}
// NOLINTEND(readability-identifier-naming)
