#include "asperity/trajectory/smooth_clock.h"

#include <gtest/gtest.h>
#include <cmath>

#include "asperity/base/random.h"

namespace asperity {
namespace {

// Samples of a 400.7 Hz device, stamped on arrival by a clock of 1 ms, some lost in bursts.
struct Stamps {
  std::vector<std::int64_t> t_ns;
  std::vector<double> true_s;
};

Stamps coarse_stamps(double delay_s) {
  Stamps out;
  Random random(3);
  for (int i = 0; i < 8000; ++i) {
    const double t = 5.0 + i / 400.7;
    if (i % 700 > 690) continue;
    const double arrival = t + delay_s * random.uniform();
    const auto stamp = static_cast<std::int64_t>(std::floor(arrival * 1e3)) * 1'000'000;
    if (!out.t_ns.empty() && stamp <= out.t_ns.back()) continue;
    out.t_ns.push_back(stamp);
    out.true_s.push_back(t);
  }
  return out;
}

TEST(SmoothClock, RemovesTheTicksOfACoarseClock) {
  const Stamps stamps = coarse_stamps(0.5e-3);
  const SmoothClockResult result = smooth_clock(stamps.t_ns, {});
  ASSERT_TRUE(result.applied);
  EXPECT_NEAR(result.period_s, 1.0 / 400.7, 1e-6);
  double mean = 0.0;
  for (std::size_t i = 0; i < stamps.t_ns.size(); ++i)
    mean += static_cast<double>(result.t_ns[i]) * 1e-9 - stamps.true_s[i];
  mean /= static_cast<double>(stamps.t_ns.size());
  double worst = 0.0;
  for (std::size_t i = 0; i < stamps.t_ns.size(); ++i) {
    worst = std::max(worst, std::abs(static_cast<double>(result.t_ns[i]) * 1e-9 - stamps.true_s[i] - mean));
  }
  // 0.33 ms RMS of jitter over some 200 samples a window: 25 µs, five times that at the ends.
  EXPECT_LT(worst, 2.5e-4);
}

TEST(SmoothClock, KeepsRegularStamps) {
  std::vector<std::int64_t> t_ns;
  for (int i = 0; i < 1000; ++i) t_ns.push_back(i * 250'000 + (i % 3) * 100);
  const SmoothClockResult result = smooth_clock(t_ns, {});
  EXPECT_FALSE(result.applied);
  EXPECT_EQ(result.t_ns, t_ns);
}

TEST(SmoothClock, KeepsStampsThatNoRegularClockExplains) {
  std::vector<std::int64_t> t_ns{0};
  Random random(1);
  for (int i = 0; i < 1000; ++i)
    t_ns.push_back(t_ns.back() + 1'000'000 + static_cast<std::int64_t>(random.uniform() * 3e7));
  const SmoothClockResult result = smooth_clock(t_ns, {});
  EXPECT_FALSE(result.applied);
  EXPECT_EQ(result.t_ns, t_ns);
}

}  // namespace
}  // namespace asperity
