#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <type_traits>
#include <vector>

#include <Eigen/Core>

namespace second_bench {

// Uniform and normal deviates that are the same with every standard library (Mersenne twister, Box and Muller).
class Dice {
 public:
  Dice(std::uint64_t seed, std::uint64_t use) : bits_(seed * 0x9E3779B97F4A7C15ULL + use * 0xD1B54A32D192ED03ULL) {}

  double uniform() { return static_cast<double>(bits_() >> 11) * 0x1.0p-53; }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  double log_uniform(double low, double high) { return low * std::exp(uniform() * std::log(high / low)); }
  bool chance(double share) { return uniform() < share; }
  int below(int count) { return static_cast<int>(uniform() * count); }
  double exponential(double mean) { return -mean * std::log(1.0 - uniform()); }
  double normal() {
    if (spare_ready_) {
      spare_ready_ = false;
      return spare_;
    }
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
    const double angle = 2.0 * std::numbers::pi * uniform();
    spare_ = radius * std::sin(angle);
    spare_ready_ = true;
    return radius * std::cos(angle);
  }
  Eigen::Vector3d normal3() {
    const double x = normal(), y = normal(), z = normal();
    return {x, y, z};
  }

 private:
  std::mt19937_64 bits_;
  double spare_ = 0.0;
  bool spare_ready_ = false;
};

// A second-order section by the bilinear transform: low-pass or band-pass about `f0_Hz` with quality `q`.
template <class T>
class Section {
 public:
  enum class Kind { kLowPass, kBandPass, kOnePole };

  Section() = default;
  Section(Kind kind, double f0_Hz, double q, double rate_Hz) {
    const double w = std::tan(std::numbers::pi * f0_Hz / rate_Hz);
    if (kind == Kind::kOnePole) {
      b_ = {w / (1.0 + w), w / (1.0 + w), 0.0};
      a_ = {(w - 1.0) / (w + 1.0), 0.0};
      return;
    }
    const double norm = 1.0 / (1.0 + w / q + w * w);
    a_ = {2.0 * (w * w - 1.0) * norm, (1.0 - w / q + w * w) * norm};
    b_ = kind == Kind::kLowPass ? std::array{w * w * norm, 2.0 * w * w * norm, w * w * norm}
                                : std::array{w / q * norm, 0.0, -w / q * norm};
  }

  // As if the input had always been x.
  void settle(const T& x) {
    const double gain = (b_[0] + b_[1] + b_[2]) / (1.0 + a_[0] + a_[1]);
    z2_ = x * (b_[2] - a_[1] * gain);
    z1_ = x * (gain - b_[0]);
  }
  T push(const T& x) {
    const T y = x * b_[0] + z1_;
    z1_ = x * b_[1] - y * a_[0] + z2_;
    z2_ = x * b_[2] - y * a_[1];
    return y;
  }

 private:
  std::array<double, 3> b_{1.0, 0.0, 0.0};
  std::array<double, 2> a_{0.0, 0.0};
  static T zero() {
    if constexpr (std::is_arithmetic_v<T>) {
      return T(0);
    } else {
      return T::Zero();
    }
  }
  T z1_ = zero(), z2_ = zero();
};

// `count` values of noise through two low-passes (`q` 0.7) or two band-passes, scaled to `rms`: smooth enough that its
// second derivative is bounded.
std::vector<double> filtered_noise(std::size_t count, double rate_Hz, Section<double>::Kind kind, double f0_Hz,
                                   double q, double rms, Dice& dice);

// A first-order Gauss–Markov process (an Ornstein–Uhlenbeck one), stationary from the start.
class GaussMarkov {
 public:
  GaussMarkov(double sigma, double time_s, Dice& dice)
      : sigma_(sigma), time_s_(time_s), value_(sigma * dice.normal()) {}
  double step(double dt_s, Dice& dice) {
    const double keep = std::exp(-dt_s / time_s_);
    value_ = keep * value_ + sigma_ * std::sqrt(1.0 - keep * keep) * dice.normal();
    return value_;
  }

 private:
  double sigma_, time_s_, value_;
};

// Noise of a density that falls as 1/f between 0.03 Hz and 30 Hz: four Gauss–Markov processes, a decade apart.
class Flicker {
 public:
  Flicker(double sigma, Dice& dice) {
    for (const double corner_Hz : {0.03, 0.3, 3.0, 30.0})
      parts_.emplace_back(0.5 * sigma, 1.0 / (2.0 * std::numbers::pi * corner_Hz), dice);
  }
  double step(double dt_s, Dice& dice) {
    double sum = 0.0;
    for (GaussMarkov& part : parts_) sum += part.step(dt_s, dice);
    return sum;
  }

 private:
  std::vector<GaussMarkov> parts_;
};

}  // namespace second_bench
