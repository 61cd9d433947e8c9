#include "asperity/link/device_clock.h"

#include <gmock/gmock.h>
#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "asperity/base/random.h"

namespace asperity {
namespace {

struct Errors {
  double median_us = 0.0;
  double p99_us = 0.0;
  double worst_us = 0.0;
};

struct Scene {
  double rate_error = 0.0;        // of the device's clock
  double rate_error_per_s = 0.0;  // its drift
  std::int64_t host_start_ns = 7'000'000'000'123;
  std::int64_t device_start_ns = 1'234'567;
  double period_s = 0.002;
  double duration_s = 60.0;
  double settle_s = 5.0;
  std::function<double(double t_s, Random&)> late_s;
};

// The times handed out against the truth: the host's time when the device's clock showed that.
Errors errors_of(const Scene& scene, std::uint64_t seed, DeviceClock clock = DeviceClock()) {
  Random random(seed);
  std::vector<double> errors_us;
  std::int64_t last_ns = 0;
  for (double t_s = 0.0; t_s < scene.duration_s; t_s += scene.period_s) {
    const double shown_s = t_s * (1.0 + scene.rate_error + 0.5 * scene.rate_error_per_s * t_s);
    const std::int64_t device_ns = scene.device_start_ns + std::llround(1e9 * shown_s);
    const std::int64_t true_ns = scene.host_start_ns + std::llround(1e9 * t_s);
    clock.observe(device_ns, true_ns + std::llround(1e9 * scene.late_s(t_s, random)));
    const std::int64_t stamp_ns = clock.stamp(device_ns);
    EXPECT_GT(stamp_ns, last_ns);
    last_ns = stamp_ns;
    if (t_s >= scene.settle_s) errors_us.push_back(1e-3 * std::abs(static_cast<double>(stamp_ns - true_ns)));
  }
  std::sort(errors_us.begin(), errors_us.end());
  Errors out;
  out.median_us = errors_us[errors_us.size() / 2];
  out.p99_us = errors_us[errors_us.size() * 99 / 100];
  out.worst_us = errors_us.back();
  std::printf("error of the times, µs: median %.1f, 99 %% %.1f, worst %.1f\n", out.median_us, out.p99_us, out.worst_us);
  return out;
}

double exponential(Random& random, double mean) { return -mean * std::log(1.0 - random.uniform()); }

TEST(DeviceClock, ExponentialLatenessAndCrystalsApart) {
  for (const double rate_error : {-200e-6, 0.0, 200e-6}) {
    Scene scene;
    scene.rate_error = rate_error;
    scene.late_s = [](double, Random& random) { return exponential(random, 1e-3); };
    // The least of 125 such delays (a bin of 0.25 s) is 8 µs in the mean.
    const Errors errors = errors_of(scene, 1);
    EXPECT_LT(errors.median_us, 20.0);
    EXPECT_LT(errors.worst_us, 100.0);
  }
}

// A radio or a busy host: every second or so everything waits up to 150 ms and comes at once.
TEST(DeviceClock, BurstsDoNotMoveIt) {
  Scene scene;
  scene.rate_error = 120e-6;
  double until_s = 0.0;
  scene.late_s = [&until_s](double t_s, Random& random) {
    if (random.chance(0.002)) until_s = std::max(until_s, t_s + random.uniform(0.0, 0.15));
    return std::max(0.0, until_s - t_s) + exponential(random, 0.5e-3);
  };
  const Errors errors = errors_of(scene, 2);
  EXPECT_LT(errors.median_us, 20.0);
  EXPECT_LT(errors.worst_us, 100.0);
}

// Three seconds in which nothing comes in time.
TEST(DeviceClock, LongLateStretch) {
  Scene scene;
  scene.rate_error = -150e-6;
  scene.late_s = [](double t_s, Random& random) {
    return (t_s > 20.0 && t_s < 23.0 ? 0.02 : 0.0) + exponential(random, 0.5e-3);
  };
  const Errors errors = errors_of(scene, 3);
  EXPECT_LT(errors.median_us, 20.0);
  EXPECT_LT(errors.worst_us, 150.0);
}

// USB: packets wait for the next millisecond's frame.
TEST(DeviceClock, PolledBus) {
  Scene scene;
  scene.rate_error = 35e-6;
  scene.late_s = [](double t_s, Random& random) {
    return std::ceil(1e3 * t_s + 1e-9) * 1e-3 - t_s + exponential(random, 50e-6);
  };
  scene.period_s = 0.00201;
  const Errors errors = errors_of(scene, 4);
  EXPECT_LT(errors.median_us, 20.0);
  EXPECT_LT(errors.worst_us, 100.0);
}

// A warming crystal: 10 ppm in a minute.
TEST(DeviceClock, DriftingRate) {
  Scene scene;
  scene.rate_error = 100e-6;
  scene.rate_error_per_s = 10e-6 / 60.0;
  scene.late_s = [](double, Random& random) { return exponential(random, 0.5e-3); };
  // The line over 16 s misses a bend of 1.7e-7 /s by some 0.5 · 1.7e-7 · 8² s = 5 µs.
  const Errors errors = errors_of(scene, 5);
  EXPECT_LT(errors.median_us, 25.0);
  EXPECT_LT(errors.worst_us, 100.0);
}

TEST(DeviceClock, BeginsUsablyAndNeverTurnsBack) {
  Scene scene;
  scene.settle_s = 1.0;
  scene.duration_s = 5.0;
  scene.late_s = [](double t_s, Random& random) { return (t_s < 0.05 ? 0.03 : 0.0) + exponential(random, 0.5e-3); };
  EXPECT_LT(errors_of(scene, 6).worst_us, 300.0);
}

TEST(DeviceClock, RateIsFound) {
  Random random(7);
  DeviceClock clock;
  for (int i = 0; i < 15000; ++i) {
    const double t_s = 0.002 * i;
    clock.observe(std::llround(1e9 * t_s * (1.0 + 80e-6)), std::llround(1e9 * (t_s + exponential(random, 1e-3))));
  }
  EXPECT_NEAR(clock.rate() - 1.0, -80e-6, 3e-6);
}

TEST(DeviceClock, TimesRiseOverARestart) {
  DeviceClock clock;
  std::int64_t last_ns = 0;
  std::int64_t host_ns = 1'000'000'000;
  for (int run = 0; run < 5; ++run) {
    for (int i = 0; i < 200; ++i) {
      host_ns += 2'000'000;
      const std::int64_t device_ns = 40 + std::int64_t{i} * 2'000'000;
      clock.observe(device_ns, host_ns);
      const std::int64_t stamp_ns = clock.stamp(device_ns);
      EXPECT_GT(stamp_ns, last_ns);
      EXPECT_NEAR(static_cast<double>(stamp_ns - host_ns), 0.0, 10.0);
      last_ns = stamp_ns;
    }
    clock.restart();
  }
}

// Where the line moves by milliseconds, the times come to it without crowding.
TEST(DeviceClock, TimesComeToAMovedLineAtHalfPace) {
  DeviceClock clock;
  clock.observe(0, 20'000'000);
  std::int64_t last_ns = clock.stamp(0);
  EXPECT_EQ(last_ns, 20'000'000);
  for (int i = 1; i <= 100; ++i) {
    const std::int64_t device_ns = std::int64_t{i} * 1'000'000;
    clock.observe(device_ns, device_ns);
    const std::int64_t stamp_ns = clock.stamp(device_ns);
    EXPECT_GE(stamp_ns - last_ns, 490'000);
    last_ns = stamp_ns;
  }
  EXPECT_NEAR(static_cast<double>(last_ns), 100e6, 1e3);
}

// Whatever times are given, they rise and nothing overflows.
TEST(DeviceClock, AnyTimesAreSurvived) {
  Random random(8);
  DeviceClock clock;
  std::int64_t last_ns = std::numeric_limits<std::int64_t>::min();
  const auto any_time = [&random] { return static_cast<std::int64_t>(random.bits()) >> (random.bits() >> 58); };
  for (int i = 0; i < 100'000; ++i) {
    if (random.chance(0.7)) clock.observe(any_time(), any_time());
    if (random.chance(0.01)) clock.restart();
    const std::int64_t stamp_ns = clock.stamp(any_time());
    ASSERT_GT(stamp_ns, last_ns);
    last_ns = stamp_ns;
  }
}

}  // namespace
}  // namespace asperity
