#include "asperity_firmware/clock.h"

#include <gmock/gmock.h>
#include <cmath>

#include "asperity/base/random.h"

namespace asperity {
namespace {

TEST(FirmwareClock, GoesOnWhereACounterWraps) {
  asp_clock64 clock{};
  std::uint64_t truth = 0xFFFF0000u;
  for (int i = 0; i < 100000; ++i) {
    ASSERT_EQ(asp_clock64_extend(&clock, static_cast<std::uint32_t>(truth)), truth);
    truth += 1'000'003;
  }
}

struct Errors {
  double worst_us = 0.0;
  double rms_us = 0.0;
  bool rising = true;
};

// A sensor 1 % off its nominal rate, whose interrupt is noticed up to `delay_us` late, uniformly.
Errors run(double true_period_ns, double delay_us, std::uint64_t seed, int skip, asp_row_clock* clock) {
  Random random(seed);
  Errors out;
  double square = 0.0;
  int count = 0;
  std::uint64_t last_ns = 0;
  double row_ns = 5e9;
  for (int batch = 0; batch < 2000; ++batch) {
    const double first_ns = row_ns;
    row_ns += 16.0 * true_period_ns;
    const double edge_ns = row_ns - true_period_ns + delay_us * 1e3 * random.uniform();
    const asp_row_times times = asp_row_clock_advance(clock, 16, static_cast<std::uint64_t>(edge_ns * 1e-3));
    for (std::uint32_t i = 0; i < 16; ++i) {
      const std::uint64_t t_ns = times.first_ns + std::uint64_t{i} * times.step_ns;
      out.rising = out.rising && t_ns > last_ns;
      last_ns = t_ns;
      if (batch < skip) continue;
      const double error_us = (static_cast<double>(t_ns) - (first_ns + i * true_period_ns)) * 1e-3 - delay_us / 2.0;
      out.worst_us = std::max(out.worst_us, std::abs(error_us));
      square += error_us * error_us;
      ++count;
    }
  }
  out.rms_us = std::sqrt(square / count);
  return out;
}

TEST(FirmwareRowClock, FollowsASensorsOwnRate) {
  for (const double off : {-0.02, -0.01, 0.0, 0.01, 0.02}) {
    asp_row_clock clock;
    asp_row_clock_init(&clock, 250000);
    const Errors errors = run(250000.0 * (1.0 + off), 0.0, 1, 3, &clock);
    EXPECT_TRUE(errors.rising);
    EXPECT_LT(errors.worst_us, 1.5) << off;  // edges are whole µs
  }
}

TEST(FirmwareRowClock, AveragesTheInterruptsJitter) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    asp_row_clock clock;
    asp_row_clock_init(&clock, 250000);
    const Errors errors = run(250000.0 * 1.01, 50.0, seed, 40, &clock);
    EXPECT_TRUE(errors.rising);
    // The edges' own deviation is 50/√12 = 14.4 µs; a line through 31 of them leaves √(4/31) of it at its end.
    EXPECT_LT(errors.rms_us, 14.4 * 0.36 * 1.3);
  }
}

TEST(FirmwareRowClock, TimesRiseWhateverTheEdges) {
  Random random(7);
  for (int run = 0; run < 200; ++run) {
    asp_row_clock clock;
    asp_row_clock_init(&clock, 250000);
    std::uint64_t last_ns = 0;
    double edge_us = 1e6;
    for (int i = 0; i < 500; ++i) {
      edge_us += random.chance(0.1) ? random.uniform(-20000.0, 40000.0) : random.uniform(0.0, 8000.0);
      if (random.chance(0.02)) asp_row_clock_restart(&clock);
      const auto rows = static_cast<std::uint32_t>(1.0 + random.uniform() * 32.0);
      const asp_row_times times =
          asp_row_clock_advance(&clock, rows, static_cast<std::uint64_t>(std::max(edge_us, 1e5)));
      ASSERT_GT(times.first_ns, last_ns);
      ASSERT_GT(times.step_ns, 0u);
      last_ns = times.first_ns + std::uint64_t{rows - 1} * times.step_ns;
    }
  }
}

TEST(FirmwareRowClock, KeepsItsRateOverARestart) {
  asp_row_clock clock;
  asp_row_clock_init(&clock, 250000);
  run(252500.0, 0.0, 1, 10, &clock);
  asp_row_clock_restart(&clock);
  const std::uint64_t edge_us = clock.last_ns / 1000 + 1'000'000;
  const asp_row_times times = asp_row_clock_advance(&clock, 16, edge_us);
  EXPECT_NEAR(times.step_ns, 252500.0, 40.0);
  EXPECT_EQ(times.first_ns + 15u * times.step_ns, edge_us * 1000);
}

}  // namespace
}  // namespace asperity
