// How well the servo loop keeps its schedule on this machine: the simulated hand strokes a textured plate for SECONDS
// at RATE, with the sleep and spin of the defaults, and for a fifth of that by sleeping alone.
//
//   servo_jitter [SECONDS [RATE]]      100 s and 1000 Hz if not given

#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/device/servo_loop.h"
#include "servo_plate.h"

namespace {

using asperity::Error;

void measure_jitter(const char* name, double seconds, double rate_Hz, double spin_s) {
  const asperity::ServoStatistics s = asperity::stroke_plate(seconds, rate_Hz, spin_s);
  std::printf("%-11s %8llu %8llu %8llu %6llu %9.2f %9.2f %9.2f %9.2f %9.2f %9.2f  %s\n", name,
              static_cast<unsigned long long>(s.ticks), static_cast<unsigned long long>(s.overruns),
              static_cast<unsigned long long>(s.skipped), static_cast<unsigned long long>(s.lost_ticks),
              1e6 * s.late_p50_s, 1e6 * s.late_p99_s, 1e6 * s.late_max_s, 1e6 * s.step_p50_s, 1e6 * s.step_p99_s,
              1e6 * s.step_max_s, s.real_time ? "SCHED_FIFO" : "no priority");
  std::fflush(stdout);
}

double number(const char* text, double low, double high) {
  const auto value = asperity::parse_double(text);
  if (!value || !(*value >= low && *value <= high)) throw Error(std::string("'") + text + "' is out of range");
  return *value;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const double seconds = argc > 1 ? number(argv[1], 1.0, 1e5) : 100.0;
    const double rate_Hz = argc > 2 ? number(argv[2], 100.0, 4000.0) : 1000.0;
    const asperity::ServoConfig defaults;
    std::printf("%g s at %g Hz; times in µs\n%-11s %8s %8s %8s %6s %9s %9s %9s %9s %9s %9s\n", seconds, rate_Hz, "",
                "ticks", "overruns", "skipped", "lost", "late p50", "p99", "max", "step p50", "p99", "max");
    measure_jitter("sleep", std::max(seconds / 5.0, 1.0), rate_Hz, 0.0);
    measure_jitter("sleep+spin", seconds, rate_Hz, defaults.spin_s);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "servo_jitter: %s\n", e.what());
    return 1;
  }
  return 0;
}
