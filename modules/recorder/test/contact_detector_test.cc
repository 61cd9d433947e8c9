#include "asperity/recorder/contact_detector.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/base/random.h"

namespace asperity {
namespace {

constexpr std::int64_t kPeriod_ns = 1'000'000;  // 1 kHz

ForceCalibration newtons() {
  ForceCalibration out;
  out.newton_per_count = 0.01;
  out.offset_newton = -1.0;
  return out;
}

double counts_of(double force_N) { return (force_N + 1.0) / 0.01; }

// The changes while `force` (counts of the sample's number) is pushed for `samples`.
template <class Force>
std::vector<ContactChange> changes(ContactDetector& detector, int samples, const Force& force, int first = 0) {
  std::vector<ContactChange> out;
  for (int i = first; i < first + samples; ++i) {
    if (const auto change = detector.push(i * kPeriod_ns, force(i))) out.push_back(*change);
  }
  return out;
}

TEST(ContactDetector, NewtonThresholdsWithHysteresisAndHold) {
  ContactDetector detector({}, newtons());
  EXPECT_TRUE(detector.ready());
  // 0 N; 0.2 N (between); 0.5 N; 0.2 N (still touching); 0.1 N.
  const auto force_N = [](int i) {
    if (i < 100) return 0.0;
    if (i < 200) return 0.2;
    if (i < 400) return 0.5;
    if (i < 900) return 0.2;
    return 0.1;
  };
  const auto seen = changes(detector, 1500, [&](int i) { return counts_of(force_N(i)); });
  ASSERT_EQ(seen.size(), 2u);
  EXPECT_TRUE(seen[0].touching);
  EXPECT_EQ(seen[0].t_ns, 200 * kPeriod_ns);
  EXPECT_FALSE(seen[1].touching);
  EXPECT_EQ(seen[1].t_ns, 899 * kPeriod_ns);
}

TEST(ContactDetector, ATimeThatDoesNotRiseIsPassedOver) {
  ContactDetector detector({}, std::nullopt);
  const auto idle = [](int i) { return 100.0 + i % 2; };
  EXPECT_TRUE(changes(detector, 1000, idle).empty());
  // Ten seconds back the idle level would follow by e²⁰ times what is off.
  EXPECT_FALSE(detector.push(-9'000 * kPeriod_ns, 101.0));
  EXPECT_TRUE(changes(detector, 1000, idle, 1000).empty());
  EXPECT_FALSE(detector.touching());
}

TEST(ContactDetector, SpikesAndMissingSamplesDoNotTouch) {
  ContactDetector detector({}, newtons());
  const auto seen = changes(detector, 3000, [](int i) {
    if (i % 2 == 1) return std::numeric_limits<double>::quiet_NaN();
    return counts_of(i % 100 < 8 ? 3.0 : 0.0);  // 8 ms, shorter than on_hold_s
  });
  EXPECT_TRUE(seen.empty());
}

TEST(ContactDetector, ShortLiftsDoNotEndATouch) {
  ContactDetector detector({}, newtons());
  const auto seen = changes(detector, 3000, [](int i) { return counts_of(i % 300 < 150 ? 1.0 : 0.0); });
  ASSERT_EQ(seen.size(), 1u);  // gaps of 0.15 s, shorter than off_hold_s
  EXPECT_TRUE(detector.touching());
}

TEST(ContactDetector, WithoutCalibrationByTheIdleLevelsNoise) {
  for (const double sign : {1.0, -1.0}) {
    ContactDetector detector({}, std::nullopt);
    EXPECT_FALSE(detector.ready());
    Random random(7);
    // Noise of 3 counts on a level that drifts by 30 counts in 10 s; touches of 60 counts.
    const auto force = [&](int i) {
      const double touch = i % 4000 >= 2000 && i % 4000 < 3000 ? 60.0 * sign : 0.0;
      return 500.0 + 0.003 * i + 3.0 * random.normal() + touch;
    };
    const auto seen = changes(detector, 12'000, force);
    EXPECT_TRUE(detector.ready());
    ASSERT_EQ(seen.size(), 6u);
    for (std::size_t i = 0; i < seen.size(); ++i) {
      EXPECT_EQ(seen[i].touching, i % 2 == 0);
      const double expected_s = 4.0 * static_cast<double>(i / 2) + (i % 2 == 0 ? 2.0 : 3.0);
      EXPECT_NEAR(static_cast<double>(seen[i].t_ns) * 1e-9, expected_s, 0.005);
    }
  }
}

TEST(ContactDetector, AConstantLevelHasTheNoiseOfRounding) {
  ContactDetector detector({}, std::nullopt);
  changes(detector, 1000, [](int) { return 48.0; });
  EXPECT_TRUE(changes(
                  detector, 1000, [](int i) { return 48.0 + i % 2; }, 1000)
                  .empty());
  EXPECT_EQ(changes(
                detector, 1000, [](int) { return 60.0; }, 2000)
                .size(),
            1u);
}

TEST(ContactDetector, RefusesThresholdsThatContradict) {
  TouchConfig config;
  config.off_N = 0.5;
  EXPECT_THAT([&] { ContactDetector(config, newtons()); },
              testing::ThrowsMessage<Error>(testing::HasSubstr("contact.off_N (0.5)")));
}

}  // namespace
}  // namespace asperity
