#pragma once

#include <pthread.h>
#include <sys/types.h>

#include <cstdint>

#include "damped_mass.h"

// What the parts of OpenHaptics' stand-in share: the device and the driver's state, and the driver's thread.
namespace fake::hd {

inline constexpr unsigned kHandle = 7;
inline constexpr unsigned kInvalidHandle = 0xFFFFFFFF;
inline constexpr unsigned kInvalidEnum = 0x100, kInvalidOperation = 0x102, kDeviceFault = 0x300, kCommError = 0x302;
inline constexpr unsigned kAlreadyInitiated = 0x301, kExceededMaxForce = 0x201, kFrameError = 0x402;
inline constexpr unsigned kMostErrors = 64;

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

State& state();

// The state's mutex.
class Lock {
 public:
  Lock();
  ~Lock() { ::pthread_mutex_unlock(&state().mutex); }
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;
};

// The process that has the device open holds a lock on the file, which ends with it however it ends; as the device's
// connection does.
void connect();
void disconnect();
bool is_connected();

void complain(unsigned code);
// The device is open and plugged in; complains where it is not.
bool usable();

// The driver's own thread, in the process that has it loaded: it calls once a millisecond, until the callback returns
// 0. All but stop_scheduler() with the lock.
using Callback = unsigned (*)(void*);
void schedule(Callback callback, void* user);
void start_scheduler();
void stop_scheduler();

}  // namespace fake::hd
