#include <gmock/gmock.h>

#include "asperity/base/error.h"
#include "asperity/recording/parse_recording.h"

namespace asperity {
namespace {

TEST(SlowAccelerometer, RowsBetweenItsSamplesLieOnStraightLines) {
  Problems problems;
  const ProbeStream probe =
      parse_probe_csv("t_ns,accel_i,accel_j,accel_k,force\n0,,,,1\n10,100,0,-4,2\n20,,,,3\n40,160,30,-1,4\n50,,,,5\n",
                      "probe.csv", problems);
  ASSERT_EQ(probe.size(), 5u);
  EXPECT_EQ(probe.accel_counts[0], Eigen::Vector3d(100, 0, -4));  // held
  EXPECT_EQ(probe.accel_counts[2], Eigen::Vector3d(120, 10, -3));
  EXPECT_EQ(probe.accel_counts[4], Eigen::Vector3d(160, 30, -1));
  EXPECT_THAT(probe.force_counts, testing::ElementsAre(1, 2, 3, 4, 5));
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].kind, "slow_accelerometer");
  EXPECT_EQ(problems[0].count, 3u);
}

TEST(SlowAccelerometer, HalfASampleIsNone) {
  Problems problems;
  const ProbeStream probe =
      parse_probe_csv("t_ns,accel_i,accel_j,accel_k,force\n0,1,2,3,1\n10,4,,6,2\n20,7,8,9,3\n", "probe.csv", problems);
  EXPECT_EQ(probe.size(), 2u);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].kind, "bad_acceleration");
}

TEST(SlowAccelerometer, OneThatNeverSpeaksIsAnError) {
  Problems problems;
  EXPECT_THAT([&] { parse_probe_csv("t_ns,accel_i,accel_j,accel_k,force\n0,,,,1\n10,,,,2\n", "probe.csv", problems); },
              testing::ThrowsMessage<Error>(testing::HasSubstr("probe.csv")));
}

}  // namespace
}  // namespace asperity
