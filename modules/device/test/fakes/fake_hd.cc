// A stand-in for OpenHaptics' libHD.so: the symbols and the behaviour that we rely on, over a simulated device.
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "fake_hd_state.h"

namespace {

using namespace fake::hd;

struct ErrorInfo {
  unsigned code;
  int internal_code;
  unsigned device;
};

constexpr double kMaxForce_N = 3.3;
constexpr double kRamp_ticks = 50.0;

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
  schedule(callback, user);
  return 11;
}
#endif

void hdStartScheduler() {
  const Lock lock;
  if (usable()) start_scheduler();
}

void hdStopScheduler() { stop_scheduler(); }

void hdUnschedule(unsigned long) {
  const Lock lock;
  schedule(nullptr, nullptr);
}

void hdSetSchedulerRate(unsigned long rate_Hz) {
  const Lock lock;
  if (rate_Hz != 1000) complain(0x101);
}
}
// NOLINTEND(readability-identifier-naming)
