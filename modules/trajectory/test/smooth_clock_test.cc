#include "asperity/trajectory/smooth_clock.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

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

// A 400 Hz device whose rows wait for the host (exponential, 0.5 ms in the mean) and get whole milliseconds: a step is
// 1 to 5 ms long. Bursts of lost rows. The stamps err by 0.58 ms RMS, nearly a quarter of the period.
TEST(SmoothClock, FindsTheClockBehindTicksAndLongWaits) {
  for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
    Random random(seed);
    Stamps stamps;
    int lost = 0;
    for (int i = 0; i < 2000; ++i) {
      const double t = 5.0 + i / 400.02;
      if (lost == 0 && random.chance(0.003)) lost = 1 + static_cast<int>(-8.0 * std::log(1.0 - random.uniform()));
      const double arrival = t - 0.5e-3 * std::log(1.0 - random.uniform());
      if (lost > 0) {
        --lost;
        continue;
      }
      auto stamp = static_cast<std::int64_t>(std::ceil(arrival * 1e3)) * 1'000'000;
      if (!stamps.t_ns.empty()) stamp = std::max(stamp, stamps.t_ns.back() + 1'000'000);
      stamps.t_ns.push_back(stamp);
      stamps.true_s.push_back(t);
    }
    const SmoothClockResult result = smooth_clock(stamps.t_ns, {});
    ASSERT_TRUE(result.applied) << "seed " << seed;
    EXPECT_NEAR(result.period_s, 1.0 / 400.02, 1e-4 / 400.0);
    double mean = 0.0, square = 0.0;
    const auto n = static_cast<double>(stamps.t_ns.size());
    const auto late = [&](std::size_t i) { return static_cast<double>(result.t_ns[i]) * 1e-9 - stamps.true_s[i]; };
    for (std::size_t i = 0; i < stamps.t_ns.size(); ++i) mean += late(i) / n;
    for (std::size_t i = 0; i < stamps.t_ns.size(); ++i) square += (late(i) - mean) * (late(i) - mean) / n;
    // 0.58 ms over the 200 samples of a window are 41 µs, twice that near the ends: 50 µs in all. A late sample next to
    // a loss may be one period off: 2.5 ms at two of 2,000 are 79 µs.
    EXPECT_LT(std::sqrt(square), 0.1e-3) << "seed " << seed;
  }
}

// Batches of so many samples at 4 kHz: each stamped when it arrives, after a wait of `wait_s` on the average, and
// counted back from there. Some samples are lost, in the midst of a batch and between two.
Stamps batch_stamps(bool counted_back, int batch_samples = 20, double wait_s = 0.2e-3) {
  constexpr double kPeriod_s = 1.0 / 4000.2;
  Stamps out;
  Random random(7);
  std::vector<std::pair<int, double>> batch;
  for (int i = 0; i < 24000; ++i) {
    const double t = 2.0 + i * kPeriod_s;
    const int first = counted_back ? 8004 : 8000;  // of samples stamped together no one knows which is lost
    const bool lost = (i >= first && i < first + 6) || (i >= 16000 && i < 16005);
    if (!lost) batch.emplace_back(i, t);
    if (i % batch_samples != batch_samples - 1) continue;
    const double arrival = t - wait_s * std::log(1.0 - random.uniform());
    for (const auto& [k, true_s] : batch) {
      const double back = counted_back ? (i - k) / 4000.0 : (i - k) * 1e-6;
      auto stamp = static_cast<std::int64_t>((arrival - back + (counted_back ? 20e-6 * random.normal() : 0.0)) * 1e9);
      if (!out.t_ns.empty()) stamp = std::max(stamp, out.t_ns.back() + 1);
      out.t_ns.push_back(stamp);
      out.true_s.push_back(true_s);
    }
    batch.clear();
  }
  return out;
}

void expect_even_clock(const Stamps& stamps) {
  const SmoothClockResult result = smooth_clock(stamps.t_ns, {});
  ASSERT_TRUE(result.applied);
  EXPECT_NEAR(result.period_s, 1.0 / 4000.2, 1e-4 / 4000.2);
  double mean = 0.0, worst_step = 0.0, worst = 0.0;
  const std::size_t n = stamps.t_ns.size();
  for (std::size_t i = 0; i < n; ++i) mean += (static_cast<double>(result.t_ns[i]) * 1e-9 - stamps.true_s[i]) / n;
  for (std::size_t i = 0; i < n; ++i) {
    worst = std::max(worst, std::abs(static_cast<double>(result.t_ns[i]) * 1e-9 - stamps.true_s[i] - mean));
    if (i == 0) continue;
    const double step_s = static_cast<double>(result.t_ns[i] - result.t_ns[i - 1]) * 1e-9;
    worst_step = std::max(worst_step, std::abs(step_s - (stamps.true_s[i] - stamps.true_s[i - 1])));
  }
  // Of a loss one sample more or less may be the batches' wait. 200 batches a second wait 0.2 ms each: 10 µs over two
  // seconds, and a line's end is twice to four times as uncertain.
  EXPECT_LT(worst_step, 1.01 / 4000.0);
  EXPECT_LT(worst, 4e-4);
}

TEST(SmoothClock, FindsTheClockBehindBatchesAndKeepsLostSamples) { expect_even_clock(batch_stamps(true)); }

// Waits of half a period, batches of 50 samples: one jump in three stands out of the 20 µs by which each stamp
// scatters.
TEST(SmoothClock, FindsTheClockBehindLongBatchesWhoseStampsScatter) {
  expect_even_clock(batch_stamps(true, 50, 0.12e-3));
}

// The same scatter, single samples: no clock of batches. 40 µs at 4 kHz are within the reach of a line over the count.
TEST(SmoothClock, SingleStampsThatScatterAreNoBatches) {
  Random random(11);
  Stamps stamps;
  for (int i = 0; i < 24000; ++i) {
    stamps.true_s.push_back(2.0 + i / 4000.2);
    const auto stamp = static_cast<std::int64_t>((stamps.true_s.back() + 20e-6 * random.normal()) * 1e9);
    stamps.t_ns.push_back(stamps.t_ns.empty() ? stamp : std::max(stamp, stamps.t_ns.back() + 1));
  }
  expect_even_clock(stamps);
}

// A damaged link: single stamps that scatter by 7 % of the period, 6 % of the frames lost. Over 100 samples the losses
// scatter by two periods, and some of the steps jump by chance; every stamp must still be at its own sample.
TEST(SmoothClock, LostFramesAreNoBatches) {
  for (const double scatter : {0.05, 0.07, 0.09}) {
    Random random(13);
    Stamps stamps;
    for (int i = 0; i < 24000; ++i) {
      const double t = 2.0 + i / 400.0;
      const double late_s = scatter / 400.0 * random.normal() - (random.chance(0.004) ? 1.0e-3 : 0.0);
      if (random.chance(0.06)) continue;
      const auto stamp = static_cast<std::int64_t>((t + late_s) * 1e9);
      stamps.true_s.push_back(t);
      stamps.t_ns.push_back(stamps.t_ns.empty() ? stamp : std::max(stamp, stamps.t_ns.back() + 1));
    }
    const SmoothClockResult result = smooth_clock(stamps.t_ns, {});
    ASSERT_TRUE(result.applied);
    EXPECT_NEAR(result.period_s, 1.0 / 400.0, 1e-4 / 400.0);
    double worst = 0.0;
    for (std::size_t i = 0; i < stamps.t_ns.size(); ++i)
      worst = std::max(worst, std::abs(static_cast<double>(result.t_ns[i]) * 1e-9 - stamps.true_s[i]));
    EXPECT_LT(worst, 0.1 / 400.0) << "stamps that scatter by " << scatter << " of a period";
  }
}

// Stamps that a decoder has made even, 3 % of the frames lost, one stamp in 300 wrong by a third of the period.
TEST(SmoothClock, LostFramesOfEvenStampsAreNoBatches) {
  Random random(17);
  Stamps stamps;
  for (int i = 0; i < 8000; ++i) {
    const double t = 2.0 + i / 400.0;
    const double late_s = random.chance(1.0 / 300.0) ? 0.8e-3 : 20e-9 * random.normal();
    if (random.chance(0.03)) continue;
    stamps.true_s.push_back(t);
    stamps.t_ns.push_back(static_cast<std::int64_t>((t + late_s) * 1e9));
  }
  const SmoothClockResult result = smooth_clock(stamps.t_ns, {});
  ASSERT_TRUE(result.applied);
  EXPECT_NEAR(result.period_s, 1.0 / 400.0, 1e-4 / 400.0);
  double worst = 0.0;
  for (std::size_t i = 0; i < stamps.t_ns.size(); ++i)
    worst = std::max(worst, std::abs(static_cast<double>(result.t_ns[i]) * 1e-9 - stamps.true_s[i]));
  EXPECT_LT(worst, 0.1 / 400.0);
}

// Eight seconds of even stamps, then batches: at the beginning none ends for long.
TEST(SmoothClock, BatchesMayBeginLate) {
  Stamps stamps = batch_stamps(true);
  const std::int64_t begin_ns = stamps.t_ns.front();
  std::vector<std::int64_t> even_ns;
  for (int i = 0; i < 32000; ++i) even_ns.push_back(begin_ns - (32000 - i) * 249'988LL);
  stamps.t_ns.insert(stamps.t_ns.begin(), even_ns.begin(), even_ns.end());
  const SmoothClockResult result = smooth_clock(stamps.t_ns, {});
  EXPECT_NEAR(result.period_s, 1.0 / 4000.2, 1e-3 / 4000.2);
}

TEST(SmoothClock, FindsTheClockBehindSamplesThatAreStampedTogether) { expect_even_clock(batch_stamps(false)); }

}  // namespace
}  // namespace asperity
