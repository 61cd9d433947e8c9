#pragma once

#include <string>

namespace asperity::hd {

// What we use of OpenHaptics' HDAPI: the types, numbers and functions of its binary interface, facts of
// docs/devices.md.
struct ErrorInfo {
  unsigned code;
  int internal_code;
  unsigned device;
};
static_assert(sizeof(ErrorInfo) == 12, "hdGetError returns 12 bytes by value");

using Callback = unsigned(void*);

inline constexpr unsigned kInvalidHandle = 0xFFFFFFFF;
inline constexpr unsigned kCallbackContinue = 1;
inline constexpr unsigned short kDefaultPriority = 32767;

inline constexpr unsigned kCurrentButtons = 0x2000;
inline constexpr unsigned kCurrentPosition_mm = 0x2050;
inline constexpr unsigned kCurrentVelocity_mmps = 0x2051;
inline constexpr unsigned kDeviceModel = 0x2501;
inline constexpr unsigned kUsableWorkspace_mm = 0x2551;
inline constexpr unsigned kUpdateRate_Hz = 0x2600;
inline constexpr unsigned kNominalMaxStiffness_N_per_mm = 0x2602;
inline constexpr unsigned kNominalMaxForce_N = 0x2603;
inline constexpr unsigned kMaxContinuousForce_N = 0x2604;
inline constexpr unsigned kCurrentForce_N = 0x2700;

inline constexpr unsigned kForceOutput = 0x4000;
inline constexpr unsigned kMaxForceClamping = 0x4001;
inline constexpr unsigned kForceRamping = 0x4002;

inline constexpr unsigned kWarmMotors = 0x200;
inline constexpr unsigned kExceededMaxForce = 0x201;
inline constexpr unsigned kExceededMaxVelocity = 0x203;
inline constexpr unsigned kCommError = 0x302;
inline constexpr unsigned kFrameError = 0x402;

struct Api {
  unsigned (*init_device)(const char*);
  void (*disable_device)(unsigned);
  void (*begin_frame)(unsigned);
  void (*end_frame)(unsigned);
  ErrorInfo (*get_error)();
  void (*enable)(unsigned);
  void (*disable)(unsigned);
  void (*get_doubles)(unsigned, double*);
  void (*set_doubles)(unsigned, const double*);
  void (*get_integers)(unsigned, int*);
  unsigned long (*schedule_asynchronous)(Callback*, void*, unsigned short);
  void (*start_scheduler)();
  void (*stop_scheduler)();
  void (*unschedule)(unsigned long);
  void (*set_scheduler_rate)(unsigned long);
  const char* (*get_string)(unsigned);  // null in drivers without it
};

// The driver from `library`, or, if that is empty, the system's libHD.so. Throws Error as load_library does.
Api load_api(const std::string& library);

// An error code in words.
std::string error_text(unsigned code);

}  // namespace asperity::hd
