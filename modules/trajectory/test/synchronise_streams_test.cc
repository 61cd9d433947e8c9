#include "asperity/trajectory/synchronise_streams.h"

#include <gmock/gmock.h>
#include <cmath>

#include "asperity/base/error.h"
#include "asperity/base/random.h"

namespace asperity {
namespace {

const Eigen::Vector3d kAxis = Eigen::Vector3d(1.0, -2.0, 0.5).normalized();
constexpr double kLatency_s = 0.012;
constexpr double kTol = 1e-9;  // nanosecond time stamps times rates of order one

// Everything changes linearly with time, so that interpolation is exact.
ProbeStream linear_probe(Random& random) {
  ProbeStream probe;
  for (double t_s = 0.1; t_s < 2.0; t_s += random.uniform(0.001, 0.004)) {
    const auto t_ns = static_cast<std::int64_t>(t_s * 1e9);
    const double t = static_cast<double>(t_ns) * 1e-9;
    probe.t_ns.push_back(t_ns);
    probe.accel_counts.push_back({t, 2.0 - t, 3.0 * t});
    probe.force_counts.push_back(probe.t_ns.size() % 3 == 1 ? 5.0 * t : std::nan(""));
  }
  return probe;
}

TrackerStream linear_tracker(Random& random) {
  TrackerStream tracker;
  for (double t_s = 0.0; t_s < 1.9; t_s += random.uniform(0.015, 0.03)) {
    const auto taken_ns = static_cast<std::int64_t>(t_s * 1e9);
    const double t = static_cast<double>(taken_ns) * 1e-9;
    tracker.t_ns.push_back(taken_ns + static_cast<std::int64_t>(kLatency_s * 1e9));
    Pose pose{exp_rotation(0.8 * t * kAxis), Eigen::Vector3d(0.1 * t, 0.2, -0.3 * t)};
    if (random.chance(0.5)) pose.rotation.coeffs() *= -1.0;
    tracker.T_world_marker.push_back(pose);
  }
  return tracker;
}

TEST(Synchronise, IsExactForUniformMotionOnUnevenTimes) {
  Random random(1);
  ProbeStream probe = linear_probe(random);
  const TrackerStream tracker = linear_tracker(random);
  Outliers outliers{std::vector<bool>(probe.size(), false), 0};
  for (const std::size_t i : {100u, 101u, 300u}) {  // nonsense, but rejected
    probe.accel_counts[i].setConstant(1e6);
    probe.force_counts[i] = -1e6;
    outliers.rejected[i] = true;
  }
  const SynchronisedStreams s = synchronise_streams(probe, outliers, tracker, kLatency_s, 5'000'000, false);
  ASSERT_GT(s.t_ns.size(), 340u);
  ASSERT_EQ(s.T_world_marker.size(), s.t_ns.size());
  for (std::size_t i = 0; i < s.t_ns.size(); ++i) {
    if (i > 0) {
      EXPECT_EQ(s.t_ns[i] - s.t_ns[i - 1], 5'000'000);
    }
    const double t = static_cast<double>(s.t_ns[i]) * 1e-9;
    EXPECT_NEAR((s.accel_counts[i] - Eigen::Vector3d(t, 2.0 - t, 3.0 * t)).norm(), 0.0, kTol);
    EXPECT_NEAR((s.T_world_marker[i].translation_m - Eigen::Vector3d(0.1 * t, 0.2, -0.3 * t)).norm(), 0.0, kTol);
    EXPECT_NEAR(s.T_world_marker[i].rotation.angularDistance(exp_rotation(0.8 * t * kAxis)), 0.0, 1e-7);
    // The force's last sample may lie before the end; it holds there.
    EXPECT_NEAR(s.force_counts[i], 5.0 * t, t < 1.85 ? kTol : 0.3);
  }
  EXPECT_GE(s.t_ns.front(), probe.t_ns.front());
}

// A vibration of two periods in 5 ms, sampled at 4 kHz: its value in the middle folds, its mean is zero.
TEST(Synchronise, AveragingKeepsFastVibrationOut) {
  Random random(4);
  ProbeStream probe;
  for (int i = 0; i < 8000; ++i) {
    probe.t_ns.push_back(250'000LL * i);
    const double t = 0.00025 * i;
    probe.accel_counts.push_back({100.0 * std::sin(2.0 * M_PI * 400.0 * t), t, 0.0});
    probe.force_counts.push_back(1.0);
  }
  const Outliers none{std::vector<bool>(probe.size(), false), 0};
  const TrackerStream tracker = linear_tracker(random);
  const auto averaged = synchronise_streams(probe, none, tracker, kLatency_s + 1e-4, 5'000'000, true);
  for (std::size_t i = 1; i + 1 < averaged.t_ns.size(); ++i) {
    EXPECT_NEAR(averaged.accel_counts[i].x(), 0.0, 0.1);
    EXPECT_NEAR(averaged.accel_counts[i].y(), static_cast<double>(averaged.t_ns[i]) * 1e-9, kTol);
  }
}

TEST(Synchronise, SaysWhatIsMissing) {
  Random random(2);
  const ProbeStream probe = linear_probe(random);
  TrackerStream tracker = linear_tracker(random);
  const Outliers none{std::vector<bool>(probe.size(), false), 0};
  EXPECT_THROW(synchronise_streams(probe, none, tracker, kLatency_s, 0, false), Error);
  EXPECT_THROW(synchronise_streams(probe, none, {}, kLatency_s, 5'000'000, false), Error);
  EXPECT_THROW(synchronise_streams(probe, none, tracker, -10.0, 5'000'000, false), Error);  // no time in common
  std::swap(tracker.t_ns[3], tracker.t_ns[4]);
  EXPECT_THROW(synchronise_streams(probe, none, tracker, kLatency_s, 5'000'000, false), Error);
}

TEST(Synchronise, AFewSamplesHoursApartAreRefused) {
  ProbeStream probe;
  TrackerStream tracker;
  for (int i = 0; i < 24; ++i) {
    probe.t_ns.push_back(i * 3'500'000'000'000LL);
    probe.accel_counts.emplace_back(0.0, 0.0, 0.0);
    probe.force_counts.push_back(0.0);
  }
  tracker.t_ns = probe.t_ns;
  tracker.T_world_marker.resize(24);
  const Outliers none{std::vector<bool>(24, false), 0};
  EXPECT_THAT([&] { synchronise_streams(probe, none, tracker, 0.0, 5'000'000, false); },
              testing::ThrowsMessage<Error>(testing::HasSubstr("too many for 24 samples")));
}

TEST(Synchronise, WithoutForceItIsNan) {
  Random random(3);
  ProbeStream probe = linear_probe(random);
  for (double& f : probe.force_counts) f = std::nan("");
  const Outliers none{std::vector<bool>(probe.size(), false), 0};
  const auto s = synchronise_streams(probe, none, linear_tracker(random), kLatency_s, 5'000'000, false);
  for (const double f : s.force_counts) EXPECT_TRUE(std::isnan(f));
}

}  // namespace
}  // namespace asperity
