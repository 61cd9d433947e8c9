#include "asperity/trajectory/smooth_clock.h"

#include <gtest/gtest.h>

#include <algorithm>
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

// Samples of a 4000.4 Hz device that arrive in batches of 25: the last one's stamp is its arrival, the others lie
// before it at the nominal period. A batch waits 0.4 ms in the mean, one in fifty several ms more.
Stamps batched_stamps(double lost_batches, double lost_samples) {
  Stamps out;
  Random random(5);
  constexpr int kBatch = 25;
  for (int first = 0; first < 24000; first += kBatch) {
    const double last_s = 2.0 + (first + kBatch - 1) / 4000.4;
    double arrival_s = last_s - 0.4e-3 * std::log(1.0 - random.uniform());
    if (random.chance(0.02)) arrival_s += random.uniform(1e-3, 4e-3);
    if (random.chance(lost_batches)) continue;
    for (int k = 0; k < kBatch; ++k) {
      if (random.chance(lost_samples)) continue;
      const double stamp_s = arrival_s - (kBatch - 1 - k) / 4000.0;
      auto stamp = static_cast<std::int64_t>(std::llround(stamp_s * 1e9));
      if (!out.t_ns.empty()) stamp = std::max(stamp, out.t_ns.back() + 1000);
      out.t_ns.push_back(stamp);
      out.true_s.push_back(2.0 + (first + k) / 4000.4);
    }
  }
  return out;
}

TEST(SmoothClock, FollowsTheClockBehindLateBatches) {
  for (const double lost : {0.0, 0.01}) {
    const Stamps stamps = batched_stamps(lost, 0.1 * lost);
    const SmoothClockResult result = smooth_clock(stamps.t_ns, {});
    ASSERT_TRUE(result.applied) << lost;
    EXPECT_NEAR(result.period_s * 4000.4, 1.0, lost == 0.0 ? 2e-4 : 2e-3);
    double mean_s = 0.0, square_s2 = 0.0, given_s2 = 0.0, given_mean_s = 0.0;
    const auto n = static_cast<double>(stamps.t_ns.size());
    for (std::size_t i = 0; i < stamps.t_ns.size(); ++i) {
      mean_s += (static_cast<double>(result.t_ns[i]) * 1e-9 - stamps.true_s[i]) / n;
      given_mean_s += (static_cast<double>(stamps.t_ns[i]) * 1e-9 - stamps.true_s[i]) / n;
    }
    for (std::size_t i = 0; i < stamps.t_ns.size(); ++i) {
      square_s2 += std::pow(static_cast<double>(result.t_ns[i]) * 1e-9 - stamps.true_s[i] - mean_s, 2) / n;
      given_s2 += std::pow(static_cast<double>(stamps.t_ns[i]) * 1e-9 - stamps.true_s[i] - given_mean_s, 2) / n;
    }
    EXPECT_GT(std::sqrt(given_s2), 0.5e-3);
    // 0.6 ms RMS over the 80 batches of a window: 0.07 ms, twice that at the ends. How many samples are lost with a batch
    // is only known to one or two; with one batch in a hundred lost the steps that this leaves are as large as the waits.
    EXPECT_LT(std::sqrt(square_s2), lost == 0.0 ? 0.2e-3 : std::sqrt(given_s2)) << lost;
  }
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
