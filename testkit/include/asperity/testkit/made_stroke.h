#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <string>

#include <fmt/format.h>

namespace asperity::testkit {

// A stroke over two waves in closed form, as recorders of several rates would write it. Off the surface until 0.2 s, at
// rest in contact until 1 s, then along x at a constant speed after a ramp of 0.2 s (v t²/2 / 0.2, so that the
// acceleration is known).
struct MadeStroke {
  double length_s = 5.0;
  double speed_mps = 0.05;
  double amplitude_m = 2e-6;  // of the wave of 2 cycles/mm; that of 5 cycles/mm has a quarter
  double noise_mps2 = 0.05;   // RMS of white noise of the sensor
  double force_N = 1.0;
  double free_N = 0.0;  // what the sensor reads off the surface
  std::uint32_t seed = 1;

  double x(double t) const {
    constexpr double kStart_s = 1.0, kRamp_s = 0.2;
    const double s = t - kStart_s;
    if (s <= 0.0) return 0.0;
    return s < kRamp_s ? 0.5 * speed_mps * s * s / kRamp_s : speed_mps * (s - 0.5 * kRamp_s);
  }
  double height(double t) const {
    const double turn = 2.0 * std::numbers::pi * x(t);
    return amplitude_m * (std::sin(2e3 * turn) + 0.25 * std::sin(5e3 * turn + 1.0));
  }
  // Its second derivative, by differences of 10 µs: the error is (2π 250 Hz · 10 µs)²/12 = 2e-5 of it.
  double acceleration(double t) const {
    constexpr double h = 1e-5;
    return (height(t + h) - 2.0 * height(t) + height(t - h)) / (h * h);
  }

  // A table of t (unless it is left out) and the acceleration along z with gravity, in `unit_mps2`.
  std::string acceleration_table(double rate_Hz, double unit_mps2, bool with_time, bool with_axes) const {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal(0.0, noise_mps2);
    std::string out;
    if (with_axes) out = with_time ? "t,ax,ay,az\n" : "ax,ay,az\n";
    for (int i = 0; i < static_cast<int>(length_s * rate_Hz); ++i) {
      const double t = i / rate_Hz;
      if (with_time) out += fmt::format("{:.6f},", t);
      const double along = (acceleration(t) + normal(random) + (with_axes ? 9.80665 : 0.0)) / unit_mps2;
      if (with_axes) out += fmt::format("{:.6f},{:.6f},", 1e-3 * normal(random), 1e-3 * normal(random));
      out += fmt::format("{:.6f}\n", along);
    }
    return out;
  }
  std::string position_table(double rate_Hz) const {
    std::string out = "t,x,y\n";
    for (int i = 0; i < static_cast<int>(length_s * rate_Hz); ++i)
      out += fmt::format("{:.3f},{:.5f},1.5\n", i / rate_Hz, 1e3 * x(i / rate_Hz));
    return out;
  }
  double force(double t) const { return t < 0.2 ? free_N : force_N; }
  std::string force_table(double rate_Hz, double unit_N, bool with_time = true) const {
    std::mt19937 random(seed + 1);
    std::normal_distribution<double> normal(0.0, 0.01);
    std::string out = with_time ? "t,f\n" : "";
    for (int i = 0; i < static_cast<int>(length_s * rate_Hz); ++i) {
      if (with_time) out += fmt::format("{:.6f},", i / rate_Hz);
      out += fmt::format("{:.5f}\n", (force(i / rate_Hz) + normal(random)) / unit_N);
    }
    return out;
  }
};

}  // namespace asperity::testkit
