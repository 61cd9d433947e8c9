// A stand-in for OpenHaptics' libHD.so: the symbols and the behaviour that we rely on, over a simulated device.
#include <chrono>
#include <cmath>
#include <cstring>
#include <mutex>
#include <thread>
#include <vector>

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

struct State {
  std::mutex mutex;
  fake::DampedMass hand;
  std::vector<unsigned> errors;  // the newest is told first
  bool absent = false;
  bool unplugged = false;
  bool stalled = false;
  bool mute = false;  // the scheduler never calls
  bool open = false;
  bool in_frame = false;
  bool force_output = false, clamping = false, ramping = false;
  double wanted_N[3] = {0.0, 0.0, 0.0};  // set in the frame
  double motor_N[3] = {0.0, 0.0, 0.0};   // since its end
  double ramp_ticks = 0.0;
  unsigned calls_out_of_order = 0;
  unsigned long frames = 0;
  unsigned (*callback)(void*) = nullptr;
  void* user = nullptr;
  std::thread scheduler;
  bool running = false;
};

State& state() {
  static State the_state;
  return the_state;
}

void complain(unsigned code) {
  if (state().errors.size() < 64) state().errors.push_back(code);
}

void schedule() {
  auto next = std::chrono::steady_clock::now();
  while (true) {
    next += std::chrono::milliseconds(1);
    std::this_thread::sleep_until(next);
    unsigned (*callback)(void*) = nullptr;
    {
      const std::lock_guard lock(state().mutex);
      if (!state().running) return;
      if (state().stalled || state().mute) continue;
      callback = state().callback;
    }
    if (callback != nullptr && callback(state().user) == 0) {
      const std::lock_guard lock(state().mutex);
      state().callback = nullptr;
    }
    const std::lock_guard lock(state().mutex);
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
  const std::lock_guard lock(state().mutex);
  const bool known = name == nullptr || std::strcmp(name, "Default Device") == 0;
  if (state().absent || !known) {
    complain(kDeviceFault);
    return kInvalidHandle;
  }
  if (state().open) {
    complain(kAlreadyInitiated);
    return kInvalidHandle;
  }
  state().open = true;
  return kHandle;
}

void hdDisableDevice(unsigned handle) {
  const std::lock_guard lock(state().mutex);
  if (handle == kHandle) state().open = false;
}

void hdBeginFrame(unsigned handle) {
  const std::lock_guard lock(state().mutex);
  if (!usable()) return;
  if (handle != kHandle || state().in_frame) {
    ++state().calls_out_of_order;
    return complain(kFrameError);
  }
  state().in_frame = true;
}

void hdEndFrame(unsigned handle) {
  const std::lock_guard lock(state().mutex);
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
  const std::lock_guard lock(state().mutex);
  if (state().errors.empty()) return {0, 0, kHandle};
  const unsigned code = state().errors.back();
  state().errors.pop_back();
  return {code, -1, kHandle};
}

void hdEnable(unsigned capability) {
  const std::lock_guard lock(state().mutex);
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
  const std::lock_guard lock(state().mutex);
  if (capability == 0x4000) state().force_output = false;
  if (capability == 0x4001) state().clamping = false;
  if (capability == 0x4002) state().ramping = false;
}

void hdGetDoublev(unsigned parameter, double* out) {
  const std::lock_guard lock(state().mutex);
  if (!usable()) return;
  const bool moving = parameter == 0x2050 || parameter == 0x2051;
  if (moving && !state().in_frame) {
    ++state().calls_out_of_order;
    return complain(kFrameError);
  }
  switch (parameter) {
    case 0x2050:
      for (int i = 0; i < 3; ++i) out[i] = 1e3 * state().hand.p_m[i];
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
  const std::lock_guard lock(state().mutex);
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
  const std::lock_guard lock(state().mutex);
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
  const std::lock_guard lock(state().mutex);
  if (parameter == 0x2501) return "Fake Touch";
  complain(kInvalidEnum);
  return nullptr;
}

#ifndef FAKE_HD_INCOMPLETE
unsigned long hdScheduleAsynchronous(unsigned (*callback)(void*), void* user, unsigned short) {
  const std::lock_guard lock(state().mutex);
  state().callback = callback;
  state().user = user;
  return 11;
}
#endif

void hdStartScheduler() {
  const std::lock_guard lock(state().mutex);
  if (!usable() || state().running) return;
  state().running = true;
  state().scheduler = std::thread(schedule);
}

void hdStopScheduler() {
  {
    const std::lock_guard lock(state().mutex);
    state().running = false;
  }
  if (state().scheduler.joinable()) state().scheduler.join();
}

void hdUnschedule(unsigned long) {
  const std::lock_guard lock(state().mutex);
  state().callback = nullptr;
}

void hdSetSchedulerRate(unsigned long rate_Hz) {
  const std::lock_guard lock(state().mutex);
  if (rate_Hz != 1000) complain(0x101);
}

// For tests.
void fake_hd_reset() {
  hdStopScheduler();
  const std::lock_guard lock(state().mutex);
  State& s = state();
  s.hand = {};
  s.errors.clear();
  s.absent = s.unplugged = s.stalled = s.mute = s.open = s.in_frame = false;
  s.force_output = s.clamping = s.ramping = false;
  for (int i = 0; i < 3; ++i) s.wanted_N[i] = s.motor_N[i] = 0.0;
  s.calls_out_of_order = 0;
  s.frames = 0;
  s.callback = nullptr;
}
void fake_hd_set(const char* what, int on) {
  const std::lock_guard lock(state().mutex);
  if (std::strcmp(what, "absent") == 0) state().absent = on != 0;
  if (std::strcmp(what, "unplugged") == 0) state().unplugged = on != 0;
  if (std::strcmp(what, "stalled") == 0) state().stalled = on != 0;
  if (std::strcmp(what, "mute") == 0) state().mute = on != 0;
}
void fake_hd_complain(unsigned code) {
  const std::lock_guard lock(state().mutex);
  complain(code);
}
void fake_hd_motor(double* out_N) {
  const std::lock_guard lock(state().mutex);
  std::memcpy(out_N, state().motor_N, sizeof state().motor_N);
}
unsigned fake_hd_calls_out_of_order() {
  const std::lock_guard lock(state().mutex);
  return state().calls_out_of_order;
}
unsigned long fake_hd_frames() {
  const std::lock_guard lock(state().mutex);
  return state().frames;
}
int fake_hd_open() {
  const std::lock_guard lock(state().mutex);
  return state().open ? 1 : 0;
}
}
// NOLINTEND(readability-identifier-naming)
