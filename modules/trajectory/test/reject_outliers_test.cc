#include "asperity/trajectory/reject_outliers.h"

#include <gtest/gtest.h>
#include <cmath>
#include <set>

namespace asperity {
namespace {

// 400 Hz of a 40 Hz vibration of 5 m/s²: neighbours differ by at most 3.2 m/s².
ProbeStream vibration(std::size_t n) {
  ProbeStream probe;
  for (std::size_t i = 0; i < n; ++i) {
    const double phase = 2.0 * M_PI * 40.0 * static_cast<double>(i) / 400.0;
    probe.t_ns.push_back(static_cast<std::int64_t>(i) * 2'500'000);
    probe.accel_counts.push_back(Eigen::Vector3d(100.0, 120.0, 110.0 + 6.0 * 5.0 * std::sin(phase)));
    probe.force_counts.push_back(i % 4 == 0 ? 90.0 : std::nan(""));
  }
  return probe;
}

Calibration calibration() {
  Calibration c;
  c.accelerometer.B = 6.0 * Eigen::Matrix3d::Identity();  // counts per m/s²
  c.force.newton_per_count = 0.025;
  return c;
}

std::set<std::size_t> marked(const Outliers& outliers) {
  std::set<std::size_t> out;
  for (std::size_t i = 0; i < outliers.rejected.size(); ++i) {
    if (outliers.rejected[i]) out.insert(i);
  }
  return out;
}

TEST(RejectOutliers, FindsSpikesOfAnyFieldAndNothingElse) {
  ProbeStream probe = vibration(400);
  probe.accel_counts[0].z() = 255.0;  // the very first
  probe.accel_counts[50].x() += 130.0;
  probe.accel_counts[120].y() += 125.0;
  probe.accel_counts[121].y() += 125.0;
  probe.force_counts[200] = 255.0;
  probe.accel_counts[399].x() = 255.0;  // the very last
  const Outliers outliers = reject_outliers(probe, calibration(), {});
  EXPECT_EQ(marked(outliers), (std::set<std::size_t>{0, 50, 120, 121, 200, 399}));
  EXPECT_EQ(outliers.count, 6u);
}

TEST(RejectOutliers, AChangeOfLevelIsKept) {
  ProbeStream probe = vibration(400);
  for (std::size_t i = 200; i < 400; ++i) probe.accel_counts[i].x() += 125.0;
  EXPECT_EQ(reject_outliers(probe, calibration(), {}).count, 0u);
}

TEST(RejectOutliers, NoSamplesNoForceNoHarm) {
  EXPECT_EQ(reject_outliers({}, calibration(), {}).count, 0u);
  ProbeStream probe = vibration(100);
  for (double& f : probe.force_counts) f = std::nan("");
  EXPECT_EQ(reject_outliers(probe, calibration(), {}).count, 0u);
}

}  // namespace
}  // namespace asperity
