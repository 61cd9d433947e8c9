#include "asperity/trajectory/sample_at_probe.h"

#include <gtest/gtest.h>
#include <cmath>

#include "asperity/base/error.h"
#include "asperity/geometry/pose.h"

namespace asperity {
namespace {

const Eigen::Vector3d kGravity_world_mps2(0.0, 9.80665, 0.0);

// The tip moves and turns uniformly, so that interpolation is exact; the acceleration is given.
TEST(SampleAtProbe, InterpolatesTheMotionAndKeepsTheSamples) {
  const auto q_at = [](double t) { return exp_rotation({0.3 * t, 0.1 * t, 0.0}); };
  const auto p_at = [](double t) { return Eigen::Vector3d(0.02 * t, 0.1, 0.3); };
  const auto a_at = [](double t) { return Eigen::Vector3d(0.0, std::sin(300.0 * t), 1.0); };
  Calibration calibration;
  calibration.accelerometer.B = 100.0 * Eigen::Matrix3d::Identity();
  calibration.force.newton_per_count = 0.5;
  TipMotion motion;
  for (int i = 0; i <= 20; ++i) {
    const double t = 0.005 * i;
    motion.t_ns.push_back(5'000'000LL * i);
    motion.p_world_tip_m.push_back(p_at(t));
    motion.q_world_marker.push_back(q_at(t));
    motion.v_world_tip_mps.push_back({0.02, 0.0, 0.0});
  }
  ProbeStream probe;
  Outliers outliers;
  for (int i = -5; i < 130; ++i) {
    const double t = 0.001 * i;
    const Eigen::Quaterniond q = exp_rotation(t * Eigen::Vector3d(0.3, 0.1, 0.0));
    probe.t_ns.push_back(1'000'000LL * i);
    probe.accel_counts.push_back(100.0 * (q.conjugate() * (a_at(t) - kGravity_world_mps2)));
    probe.force_counts.push_back(i % 2 == 0 ? 3.0 : std::nan(""));
    outliers.rejected.push_back(i == 40);
  }
  const TipMotion out = sample_at_probe(probe, outliers, calibration, kGravity_world_mps2, motion);
  ASSERT_EQ(out.size(), 100u);  // 0 to 100 ms without the rejected one
  for (std::size_t i = 0; i < out.size(); ++i) {
    const double t = static_cast<double>(out.t_ns[i]) * 1e-9;
    EXPECT_NEAR((out.p_world_tip_m[i] - p_at(t)).norm(), 0.0, 1e-12);
    EXPECT_NEAR((out.a_world_tip_mps2[i] - a_at(t)).norm(), 0.0, 1e-9);
    EXPECT_NEAR(out.v_world_tip_mps[i].x(), 0.02, 1e-15);
    EXPECT_NE(out.t_ns[i], 40'000'000);
    EXPECT_EQ(std::isnan(out.force_N[i]), out.t_ns[i] / 1'000'000 % 2 != 0);
  }
  EXPECT_THROW(sample_at_probe(probe, outliers, calibration, kGravity_world_mps2, {}), Error);
  EXPECT_THROW(sample_at_probe(probe, {}, calibration, kGravity_world_mps2, motion), Error);
}

}  // namespace
}  // namespace asperity
