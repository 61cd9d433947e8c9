#pragma once

#include <string>

namespace asperity::dhd {

// What we use of Force Dimension's DHD 3.17: its binary interface, facts of docs/devices.md.
inline constexpr char kDefaultDevice = -1;  // C callers must always pass it
inline constexpr double kWatchdogStep_s = 125e-6;
inline constexpr int kTimeGuard = 1;       // asked too soon: the values are those of before
inline constexpr int kMotorSaturated = 2;  // the force is the greatest there is

struct Api {
  int (*open)();
  int (*close)(char);
  int (*enable_force)(unsigned char, char);
  int (*get_position)(double*, double*, double*, char);         // m
  int (*get_linear_velocity)(double*, double*, double*, char);  // m/s
  int (*set_force)(double, double, double, char);               // N
  int (*get_button_mask)(char);
  const char* (*last_error)();
  const char* (*system_name)(char);  // null in drivers without it
  // The controller's own watchdog, an expert function since 3.3.2, in steps of 125 µs; null in drivers without it.
  int (*enable_expert_mode)();
  int (*disable_expert_mode)();
  int (*set_watchdog)(unsigned char, char);
  int (*get_watchdog)(unsigned char*, char);
};

// The driver from `library`, or, if that is empty, the first of libdrd.so.3, libdrd.so, libdhd.so.3 and libdhd.so,
// by the system's search and then in $FDSDK/lib/release/lin-x86_64-gcc/. Throws Error as load_library does.
Api load_api(const std::string& library);

}  // namespace asperity::dhd
