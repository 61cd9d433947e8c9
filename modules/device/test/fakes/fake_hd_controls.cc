// What tests do to OpenHaptics' stand-in, and see of it (fake_drivers.h).
#include <algorithm>
#include <cstring>

#include "fake_hd_state.h"

using namespace fake::hd;

namespace {

constexpr int kGlitchReadings = 8;

}  // namespace

extern "C" {

// At the first of them the file is new.
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
  stop_scheduler();
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
  schedule(nullptr, nullptr);
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
