#include "asperity/signal/resample.h"

#include <cmath>

#include <gtest/gtest.h>

#include "asperity/base/error.h"
#include "asperity/base/random.h"

namespace asperity {
namespace {

const double kNan = std::nan("");

TEST(Resample, IsExactForALineOnUnevenTimes) {
  Random random(1);
  std::vector<double> t, x;
  for (double now = 0.0; now < 10.0; now += random.uniform(0.01, 0.3)) {
    t.push_back(now);
    x.push_back(2.0 - 3.0 * now);
  }
  const auto y = resample_uniform(t, x, 0.5, 0.01, 900);
  for (std::size_t i = 0; i < y.size(); ++i) {
    EXPECT_NEAR(y[i], 2.0 - 3.0 * (0.5 + 0.01 * static_cast<double>(i)), 1e-12);
  }
}

TEST(Resample, OutsideAndInGapsItIsNan) {
  const std::vector<double> t{0.0, 1.0, 2.0, 3.0, 10.0};
  const std::vector<double> x{0.0, 1.0, kNan, 3.0, 10.0};
  const auto y = resample_uniform(t, x, -0.5, 0.5, 23, 2.0);
  EXPECT_TRUE(std::isnan(y[0]));  // -0.5: before the first
  EXPECT_EQ(y[1], 0.0);
  EXPECT_EQ(y[2], 0.5);
  EXPECT_EQ(y[3], 1.0);
  for (const std::size_t i : {4u, 5u, 6u}) EXPECT_TRUE(std::isnan(y[i])) << i;  // beside the nan
  EXPECT_EQ(y[7], 3.0);
  EXPECT_TRUE(std::isnan(y[12]));  // 5.5: inside a step wider than 2
  EXPECT_EQ(y[21], 10.0);
  EXPECT_TRUE(std::isnan(y[22]));
}

TEST(Resample, WhereTimeStandsStillTheLaterSampleCounts) {
  const std::vector<double> t{0.0, 1.0, 1.0, 2.0};
  const std::vector<double> x{0.0, 5.0, 7.0, 8.0};
  EXPECT_EQ(interpolate(t, x, std::vector<double>{1.0, 1.5}), (std::vector<double>{7.0, 7.5}));
}

TEST(Resample, RejectsWhatIsNotASeries) {
  const std::vector<double> x{1.0, 2.0};
  EXPECT_THROW(resample_uniform(std::vector<double>{1.0, 0.0}, x, 0, 1, 1), Error);
  EXPECT_THROW(resample_uniform(std::vector<double>{1.0, kNan}, x, 0, 1, 1), Error);
  EXPECT_THROW(resample_uniform(std::vector<double>{1.0}, x, 0, 1, 1), Error);
  EXPECT_THROW(resample_uniform(std::vector<double>{0.0, 1.0}, x, 0, 0.0, 1), Error);
  EXPECT_THROW(interpolate(std::vector<double>{0.0, 1.0}, x, std::vector<double>{1.0, 0.5}), Error);
}

TEST(IntervalMeans, AreTheMeansOfTheInterpolation) {
  // 0 up to 2, then back to 0 at 3, then level: areas by hand.
  const std::vector<double> t{0.0, 2.0, 3.0, 10.0};
  const std::vector<double> x{0.0, 2.0, 0.0, 0.0};
  const auto y = interval_means(t, x, std::vector<double>{0.0, 1.0, 2.0, 3.0, 8.0}, 2.0);
  EXPECT_DOUBLE_EQ(y[0], 0.5);   // [0, 1] only
  EXPECT_DOUBLE_EQ(y[1], 1.0);   // [0, 2]
  EXPECT_DOUBLE_EQ(y[2], 1.25);  // 1.5 and 1 over 2
  EXPECT_DOUBLE_EQ(y[3], 0.5);
  EXPECT_DOUBLE_EQ(y[4], 0.0);
  EXPECT_THROW(interval_means(t, x, std::vector<double>{20.0}, 2.0), Error);
  EXPECT_THROW(interval_means(t, x, std::vector<double>{1.0}, 0.0), Error);
  EXPECT_THROW(interval_means({}, {}, std::vector<double>{1.0}, 1.0), Error);
}

TEST(IntervalMeans, SuppressWhatWouldFold) {
  std::vector<double> t, x, at;
  for (int i = 0; i < 10000; ++i) {
    t.push_back(0.00025 * i);
    x.push_back(3.0 + std::sin(2.0 * 3.141592653589793 * 400.0 * t.back()));  // two periods in 5 ms
  }
  for (int i = 1; i < 400; ++i) at.push_back(0.005 * i + 0.0011);
  for (const double mean : interval_means(t, x, at, 0.005)) EXPECT_NEAR(mean, 3.0, 1e-3);
}

TEST(BridgeGaps, DrawsTheLineOverTime) {
  const std::vector<double> t{0.0, 1.0, 3.0, 4.0, 5.0};
  EXPECT_EQ(bridge_gaps(t, std::vector<double>{kNan, 2.0, kNan, 8.0, kNan}),
            (std::vector<double>{2.0, 2.0, 6.0, 8.0, 8.0}));
  EXPECT_EQ(bridge_gaps(std::vector<double>{1.0, kNan, kNan, 4.0}), (std::vector<double>{1.0, 2.0, 3.0, 4.0}));
  EXPECT_TRUE(std::isnan(bridge_gaps(std::vector<double>{kNan, kNan})[1]));
}

}  // namespace
}  // namespace asperity
