#include "asperity/import/align_clocks.h"

#include <gmock/gmock.h>
#include <random>

#include "known_motion.h"

namespace asperity {
namespace {

using testing::HasSubstr;
using testing_import::known_motion;

// Poses whose clock began at another time and runs 80 ppm fast, with 0.5 mrad of noise, against a gyroscope with 5
// mrad/s.
TEST(AlignClocks, FindsOffsetAndDriftWithinTheirErrors) {
  ImportStreams streams = known_motion(60.0);
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  const auto noise = [&](double sigma) {
    return sigma * Eigen::Vector3d(normal(random), normal(random), normal(random));
  };
  for (auto& omega : streams.rate.value) omega += noise(5e-3);
  constexpr double kDrift = -80e-6;
  const std::int64_t epoch_ns = 1'700'000'000'123'456'789;
  std::vector<std::int64_t> true_ns;
  for (std::size_t i = 0; i < streams.pose.size(); ++i) {
    true_ns.push_back(streams.pose.t_ns[i]);
    streams.pose.t_ns[i] = epoch_ns + std::llround(static_cast<double>(streams.pose.t_ns[i]) / (1.0 + kDrift));
    streams.pose.T_world_body[i].rotation = streams.pose.T_world_body[i].rotation * exp_rotation(noise(5e-4));
  }
  const ClockFit fit = align_clocks(streams.pose, streams.rate);
  ASSERT_TRUE(fit.is_determined) << fit.reason;
  EXPECT_LT(fit.offset_sigma_s, 1e-3);
  EXPECT_NEAR(fit.drift, kDrift, 4.0 * fit.drift_sigma);
  EXPECT_LT(fit.drift_sigma, 3e-5);
  for (const std::size_t i : {std::size_t{0}, true_ns.size() / 2, true_ns.size() - 1}) {
    // Four standard errors of offset and drift over 30 s.
    EXPECT_NEAR(static_cast<double>(fit.imu_time_ns(streams.pose.t_ns[i]) - true_ns[i]) * 1e-9, 0.0,
                4.0 * std::hypot(fit.offset_sigma_s, 30.0 * fit.drift_sigma));
  }
}

TEST(AlignClocks, SaysWhyNothingIsDetermined) {
  ImportStreams still = known_motion(10.0);
  for (auto& pose : still.pose.T_world_body) pose.rotation.setIdentity();
  EXPECT_THAT(align_clocks(still.pose, still.rate).reason, HasSubstr("too little rotation"));
  EXPECT_THAT(align_clocks(still.pose, {}).reason, HasSubstr("no gyroscope"));

  // A pendulum: every second is like the one before it.
  ImportStreams pendulum;
  for (int i = 0; i < 4000; ++i) {
    const double angle = 0.5 * std::sin(2.0 * 3.141592653589793 * 0.01 * i);
    pendulum.pose.t_ns.push_back(std::int64_t{10'000'000} * i);
    pendulum.pose.T_world_body.push_back({exp_rotation({angle, 0.0, 0.0}), {}});
    pendulum.rate.t_ns.push_back(std::int64_t{10'000'000} * i);
    pendulum.rate.value.emplace_back(3.14159 * std::cos(2.0 * 3.141592653589793 * 0.01 * i), 0.0, 0.0);
  }
  EXPECT_THAT(align_clocks(pendulum.pose, pendulum.rate).reason, HasSubstr("repeats itself"));
}

}  // namespace
}  // namespace asperity
