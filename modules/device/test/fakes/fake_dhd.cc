// A stand-in for Force Dimension's libdhd.so: the symbols and the behaviour that we rely on, over a simulated device
// that lives by a millisecond at each dhdSetForce.
#include <fcntl.h>
#include <sys/mman.h>
#include <time.h>
#include <unistd.h>
#include <cmath>
#include <cstdlib>
#include <cstring>

#include "damped_mass.h"
#include "fake_controller.h"

namespace {

struct State {
  fake::DampedMass hand;  // x right, y up, z toward the user
  bool absent = false;
  bool unplugged = false;
  bool stalled = false;
  bool refuses_force = false;
  bool refuses_position = false;
  int failures_to_come = 0;
  bool open = false;
  bool force_enabled = false;
  bool wrong_device = false;
  bool expert = false;
  bool no_watchdog = false;
  unsigned char watchdog_steps = 0;     // of 125 µs
  long forces_left = -1;                // until it is unplugged, told by FAKE_DHD_UNPLUG_AFTER; negative: it never is
  double motor_N[3] = {0.0, 0.0, 0.0};  // as commanded, x right, y up, z toward the user
  const char* error = "no error";
};

State& state() {
  static State the_state;
  return the_state;
}

constexpr double kMaxForce_N = 12.0;

int fail(const char* why) {
  state().error = why;
  return -1;
}

// What a test outside sees, if one looks.
fake::Controller* controller() {
  static fake::Controller* const mapped = []() -> fake::Controller* {
    const char* const path = std::getenv("FAKE_DHD_CONTROLLER");
    const int file = path != nullptr ? ::open(path, O_RDWR | O_CLOEXEC) : -1;
    if (file < 0) return nullptr;
    void* const at = ::mmap(nullptr, sizeof(fake::Controller), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    ::close(file);
    return at == MAP_FAILED ? nullptr : static_cast<fake::Controller*>(at);
  }();
  return mapped;
}

int trouble() { return controller() != nullptr ? controller()->trouble : fake::Controller::kNone; }

void tell_controller() {
  if (controller() == nullptr) return;
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  std::memcpy(controller()->force_N, state().motor_N, sizeof state().motor_N);
  controller()->set_at_ns = std::int64_t{1'000'000'000} * now.tv_sec + now.tv_nsec;
  controller()->watchdog_steps = state().watchdog_steps;
  controller()->enabled = state().force_enabled ? 1 : 0;
}

// 0, or the error of a call to the device `id`.
int refusal(char id) {
  if (id != -1) {
    state().wrong_device = true;
    return fail("invalid device index");
  }
  if (!state().open) return fail("device not ready");
  if (state().failures_to_come > 0) {
    --state().failures_to_come;
    return fail("timeout");
  }
  if (trouble() == fake::Controller::kHangs) ::sleep(2);
  return state().unplugged || trouble() == fake::Controller::kUnplugged ? fail("communication error") : 0;
}

}  // namespace

// The vendor's names.
// NOLINTBEGIN(readability-identifier-naming)
extern "C" {

int dhdOpen() {
  if (state().absent) return fail("no device found");
  if (state().open) return fail("device busy");
  state().open = true;
  if (const char* const forces = std::getenv("FAKE_DHD_UNPLUG_AFTER")) state().forces_left = std::atol(forces);
  return 0;
}

int dhdClose(char id) {
  const int answer = refusal(id);
  state().open = false;
  return answer;
}

int dhdEnableForce(unsigned char on, char id) {
  if (refusal(id) < 0) return -1;
  state().force_enabled = on != 0;
  tell_controller();
  return 0;
}

int dhdGetPosition(double* x, double* y, double* z, char id) {
  if (refusal(id) < 0) return -1;
  if (state().refuses_position) return fail("no position");
  *x = state().hand.p_m[2];
  *y = state().hand.p_m[0];
  *z = state().hand.p_m[1];
  static int glitches = 0;
  if (trouble() == fake::Controller::kGlitch && glitches++ < 8) *z -= 30e-3;
  if (trouble() == fake::Controller::kGarbage) *z = std::nan("");
  return state().stalled ? 1 : 0;
}

int dhdGetLinearVelocity(double* x, double* y, double* z, char id) {
  if (refusal(id) < 0) return -1;
  *x = state().hand.v_mps[2];
  *y = state().hand.v_mps[0];
  *z = state().hand.v_mps[1];
  return 0;
}

int dhdSetForce(double x, double y, double z, char id) {
  // What is commanded is kept even if nobody is there to take it: tests look at it.
  state().motor_N[0] = y;
  state().motor_N[1] = z;
  state().motor_N[2] = x;
  if (state().forces_left == 0) state().unplugged = true;
  if (state().forces_left > 0) --state().forces_left;
  if (refusal(id) < 0) return -1;
  if (state().refuses_force) return fail("no force");
  if (!state().force_enabled) return fail("force is off");
  const double norm_N = std::hypot(x, y, z);
  if (norm_N > kMaxForce_N) {
    for (double& f_N : state().motor_N) f_N *= kMaxForce_N / norm_N;
  }
  tell_controller();
  if (!state().stalled) state().hand.step(state().motor_N);
  return norm_N > kMaxForce_N ? 2 : 0;
}

int dhdEnableExpertMode() {
  state().expert = true;
  return 0;
}

int dhdDisableExpertMode() {
  state().expert = false;
  return 0;
}

int dhdSetWatchdog(unsigned char steps, char id) {
  if (refusal(id) < 0) return -1;
  if (!state().expert) return fail("expert mode is off");
  if (state().no_watchdog) return fail("not available");
  state().watchdog_steps = steps;
  return 0;
}

int dhdGetWatchdog(unsigned char* steps, char id) {
  if (refusal(id) < 0) return -1;
  *steps = state().watchdog_steps;
  return 0;
}

int dhdGetButtonMask(char id) { return refusal(id) < 0 ? -1 : 5; }

#ifndef FAKE_DHD_INCOMPLETE
const char* dhdErrorGetLastStr() { return state().error; }
#endif

const char* dhdGetSystemName(char id) { return refusal(id) < 0 ? nullptr : "Fake omega.3"; }

// For tests.
void fake_dhd_reset() { state() = State(); }
void fake_dhd_set(const char* what, int value) {
  if (std::strcmp(what, "absent") == 0) state().absent = value != 0;
  if (std::strcmp(what, "unplugged") == 0) state().unplugged = value != 0;
  if (std::strcmp(what, "stalled") == 0) state().stalled = value != 0;
  if (std::strcmp(what, "refuses_force") == 0) state().refuses_force = value != 0;
  if (std::strcmp(what, "refuses_position") == 0) state().refuses_position = value != 0;
  if (std::strcmp(what, "no_watchdog") == 0) state().no_watchdog = value != 0;
  if (std::strcmp(what, "failures") == 0) state().failures_to_come = value;
}
void fake_dhd_move(double x, double y, double z) {
  state().hand.p_m[0] = x;
  state().hand.p_m[1] = y;
  state().hand.p_m[2] = z;
}
void fake_dhd_motor(double* out_N) { std::memcpy(out_N, state().motor_N, sizeof state().motor_N); }
int fake_dhd_wrong_device() { return state().wrong_device ? 1 : 0; }
int fake_dhd_watchdog_steps() { return state().watchdog_steps; }
int fake_dhd_expert() { return state().expert ? 1 : 0; }
int fake_dhd_force_enabled() { return state().force_enabled ? 1 : 0; }
int fake_dhd_open() { return state().open ? 1 : 0; }
}
// NOLINTEND(readability-identifier-naming)
