#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>
#include <vector>

#include "asperity/base/random.h"
#include "asperity/import/stroke.h"

namespace asperity::test {

// Strokes of which nothing that they hold is of a surface, to count how often one is taken for a touch.
enum class AirNoise {
  kWhite,
  kPink,     // density as 1/f from 0.5 Hz
  kBrown,    // as 1/f²
  kHum,      // 50 Hz and 150 Hz above white noise
  kBursts,   // white, its level changing by 35 % RMS within 50 ms
  kShaken,   // a hand that shakes the probe in the air while it moves, and holds it still before
  kDrifting  // white, its level changing by 35 % RMS within 0.5 s
};
inline constexpr std::array<std::string_view, 7> kAirNoiseNames{"white",  "1/f",    "1/f²",    "hum",
                                                                "bursts", "shaken", "drifting"};

// Gaussian with the correlation time, variance 1.
class Wander {
 public:
  Wander(double time_s, double rate_Hz, Random& random)
      : keep_(std::exp(-1.0 / (time_s * rate_Hz))), value_(random.normal()) {}
  double next(Random& random) { return value_ = keep_ * value_ + std::sqrt(1.0 - keep_ * keep_) * random.normal(); }

 private:
  double keep_, value_;
};

inline std::vector<double> air_noise(AirNoise kind, std::size_t samples, double rate_Hz, Random& random) {
  std::vector<double> out(samples);
  std::vector<Wander> poles;
  if (kind == AirNoise::kPink)
    for (double f = 0.5; f < rate_Hz; f *= 2.0) poles.emplace_back(1.0 / (2.0 * std::numbers::pi * f), rate_Hz, random);
  if (kind == AirNoise::kBrown) poles.emplace_back(0.3, rate_Hz, random);
  Wander level(kind == AirNoise::kDrifting ? 0.5 : 0.05, rate_Hz, random);
  const double phase = random.uniform(0.0, 6.28);
  for (std::size_t i = 0; i < samples; ++i) {
    const double turn = 2.0 * std::numbers::pi * static_cast<double>(i) / rate_Hz;
    if (poles.empty()) out[i] = random.normal();
    for (Wander& pole : poles) out[i] += pole.next(random);
    if (kind == AirNoise::kHum) out[i] += 3.0 * std::sin(50.0 * turn + phase) + std::sin(150.0 * turn);
    if (kind == AirNoise::kBursts || kind == AirNoise::kDrifting) out[i] *= std::exp(0.35 * level.next(random));
  }
  return out;
}

struct AirStroke {
  AirNoise noise = AirNoise::kWhite;
  double rate_Hz = 1000.0;
  double still_s = 0.5;  // before the motion, off the surface
  double moving_s = 2.0;
  bool has_speed = true;
  bool has_force = true;  // that reads a touch from the begin of the motion on, so that only the vibration is judged
  double tip_kg = 0.0;    // > 0: no touch; the force is the tip's inertia and the sensor's noise
};

// The motion is back and forth at 1 to 3 Hz and 0.1 to 0.4 m/s, and has tremor of 8 to 12 Hz.
inline Stroke air_stroke(const AirStroke& made, Random& random) {
  Stroke out;
  out.rate_Hz = made.rate_Hz;
  out.high_pass_Hz = 10.0;
  out.axes = 3;
  out.speed_is_measured = made.has_speed;
  out.force_is_measured = made.has_force;
  const auto samples = static_cast<std::size_t>((made.still_s + made.moving_s) * made.rate_Hz);
  out.acceleration_mps2 = air_noise(made.noise, samples, made.rate_Hz, random);
  for (double& a : out.acceleration_mps2) a *= 0.05;
  const double swing_Hz = random.uniform(1.0, 3.0), speed_mps = random.uniform(0.1, 0.4);
  const double tremor_Hz = random.uniform(8.0, 12.0), tremor_mps2 = random.uniform(0.1, 1.0);
  std::vector<Wander> shaking;  // what of a hand and its tool is above 40 Hz while they move
  shaking.emplace_back(0.02, made.rate_Hz, random);
  const double shaking_mps2 = random.uniform(0.05, 0.5);
  for (std::size_t i = 0; i < samples; ++i) {
    const double t = static_cast<double>(i) / made.rate_Hz - made.still_s;
    const double turn = 2.0 * std::numbers::pi * std::max(0.0, t);
    // From rest: v = speed sin, so a begins with a step as a hand's does, within 50 ms.
    const double v = t > 0.0 ? speed_mps * std::sin(swing_Hz * turn) : 0.0;
    const double a = t > 0.0 ? speed_mps * 2.0 * std::numbers::pi * swing_Hz * std::cos(swing_Hz * turn) : 0.0;
    const double shake = t > 0.0 ? shaking_mps2 * shaking.front().next(random) : 0.0;
    if (made.noise == AirNoise::kShaken) out.acceleration_mps2[i] += shake + tremor_mps2 * std::sin(tremor_Hz * turn);
    if (made.has_speed) out.speed_mps.push_back(std::abs(v));
    if (!made.has_force) continue;
    const double touch = t > 0.0 ? 1.0 : 0.0;
    const double inertia = made.tip_kg * (a + (made.noise == AirNoise::kShaken ? out.acceleration_mps2[i] : 0.0));
    out.force_N.push_back((made.tip_kg > 0.0 ? inertia : touch) + 0.003 * random.normal());
  }
  return out;
}

}  // namespace asperity::test
