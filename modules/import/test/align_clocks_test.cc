#include "asperity/import/align_clocks.h"

#include <gmock/gmock.h>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

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
  const auto noise = [&](double sigma) -> Eigen::Vector3d {
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
  const ClockFit fit = align_clocks(streams.pose, streams.rate, {}, {});
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
  EXPECT_THAT(align_clocks(still.pose, still.rate, {}, {}).reason, HasSubstr("too little rotation"));
  EXPECT_THAT(align_clocks(still.pose, {}, {}, {}).reason, HasSubstr("the gyroscope is missing"));

  // A pendulum: every second is like the one before it.
  ImportStreams pendulum;
  for (int i = 0; i < 4000; ++i) {
    const double angle = 0.5 * std::sin(2.0 * 3.141592653589793 * 0.01 * i);
    pendulum.pose.t_ns.push_back(std::int64_t{10'000'000} * i);
    pendulum.pose.T_world_body.push_back({exp_rotation({angle, 0.0, 0.0}), {}});
    pendulum.rate.t_ns.push_back(std::int64_t{10'000'000} * i);
    pendulum.rate.value.emplace_back(3.14159 * std::cos(2.0 * 3.141592653589793 * 0.01 * i), 0.0, 0.0);
  }
  EXPECT_THAT(align_clocks(pendulum.pose, pendulum.rate, {}, {}).reason, HasSubstr("repeats itself"));
}

const std::vector<Eigen::Vector3d> kUps{Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ()};

// A knock on a table: lifted and brought down within a quarter of a second, then stopped from 0.54 m/s within 2 ms.
// Height above the table and its second derivative.
struct Knocked {
  double z_m = 0.0, a_mps2 = 0.0;
};
Knocked knock(double t_s) {
  constexpr double kFall_s = 0.25, kStop_s = 2e-3, kHeight_m = 0.02 * 6.75;
  const double u = t_s / kFall_s + 1.0;
  if (u < 0.0) return {};
  if (u < 1.0) return {kHeight_m * u * u * (1.0 - u), kHeight_m * (2.0 - 6.0 * u) / (kFall_s * kFall_s)};
  const double speed_mps = kHeight_m / kFall_s, stop_mps2 = speed_mps / kStop_s;
  if (t_s < kStop_s) return {-speed_mps * t_s + 0.5 * stop_mps2 * t_s * t_s, stop_mps2};
  return {-0.5 * speed_mps * kStop_s, 0.0};
}

// A body that lies still, and is knocked on the table at the times; no gyroscope.
ImportStreams knocked_body(const std::vector<double>& knocks_s, double length_s, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  const auto noise = [&](double sigma) -> Eigen::Vector3d {
    return sigma * Eigen::Vector3d(normal(random), normal(random), normal(random));
  };
  const auto at = [&](double t_s) {
    Knocked out;
    for (const double knock_s : knocks_s) {
      const Knocked one = knock(t_s - knock_s);
      out.z_m += one.z_m;
      out.a_mps2 += one.a_mps2;
    }
    return out;
  };
  const Eigen::Quaterniond q = exp_rotation({0.3, -0.2, 1.0});
  ImportStreams out;
  for (int i = 0; i < static_cast<int>(120.0 * length_s); ++i) {
    const double t_s = i / 120.0;
    out.pose.t_ns.push_back(std::llround(1e9 * t_s));
    out.pose.T_world_body.push_back({q, Eigen::Vector3d(0.1, 0.2, 0.8 + at(t_s).z_m) + noise(1e-4)});
  }
  for (int i = 0; i < static_cast<int>(1000.0 * length_s); ++i) {
    const double t_s = i / 1000.0;
    out.specific_force.t_ns.push_back(std::llround(1e9 * t_s));
    out.specific_force.value.push_back(q.conjugate() * Eigen::Vector3d(0.0, 0.0, 9.81 + at(t_s).a_mps2) + noise(0.05));
  }
  return out;
}

TEST(AlignClocks, ByKnocksWithoutAGyroscope) {
  constexpr double kDrift = 40e-6, kOffset_s = 12.3456;
  for (const std::uint32_t seed : {1u, 2u, 3u, 4u, 5u}) {
    ImportStreams streams = knocked_body({3.3, 4.9, 56.2}, 60.0, seed);
    for (auto& t_ns : streams.pose.t_ns)
      t_ns = std::llround(static_cast<double>(t_ns) * (1.0 - kDrift) - 1e9 * kOffset_s);
    const ClockFit fit = align_clocks(streams.pose, {}, streams.specific_force, kUps);
    ASSERT_TRUE(fit.is_determined) << fit.reason;
    EXPECT_EQ(fit.by, "acceleration");
    EXPECT_LT(fit.offset_sigma_s, 1e-3);
    EXPECT_NEAR(fit.drift, kDrift, 4.0 * fit.drift_sigma);
    EXPECT_LT(fit.drift_sigma, 5e-5);
    for (const double t_s : {0.0, 30.0, 60.0}) {
      const std::int64_t pose_ns = std::llround(1e9 * (t_s * (1.0 - kDrift) - kOffset_s));
      EXPECT_NEAR(static_cast<double>(fit.imu_time_ns(pose_ns)) * 1e-9, t_s,
                  4.0 * std::hypot(fit.offset_sigma_s, 30.0 * fit.drift_sigma));
    }
  }
}

// A motion that turns slowly, and whose frequency rises: one that repeats itself is refused.
TEST(AlignClocks, ByAHandsAccelerationWithoutAGyroscope) {
  ImportStreams streams = known_motion(60.0);
  const auto position = [](double t) {
    return Eigen::Vector3d(0.04 * std::sin(4.0 * t + 0.06 * t * t), 0.03 * std::sin(5.0 * t - 0.02 * t * t),
                           0.9 + 0.02 * std::sin(6.0 * t + 0.03 * t * t));
  };
  for (std::size_t i = 0; i < streams.pose.size(); ++i) {
    streams.pose.T_world_body[i].translation_m = position(1e-9 * static_cast<double>(streams.pose.t_ns[i]));
    streams.pose.t_ns[i] += 5'000'000'000;
  }
  for (std::size_t i = 0; i < streams.specific_force.size(); ++i) {
    constexpr double h = 1e-4;
    const double t = 1e-9 * static_cast<double>(streams.specific_force.t_ns[i]);
    const Eigen::Vector3d a_mps2 = (position(t + h) - 2.0 * position(t) + position(t - h)) / (h * h);
    streams.specific_force.value[i] =
        testing_import::rotation_at(0.2 * t).conjugate() * (a_mps2 + Eigen::Vector3d(0.0, 0.0, 9.81));
  }
  const ClockFit fit = align_clocks(streams.pose, {}, streams.specific_force, kUps);
  ASSERT_TRUE(fit.is_determined) << fit.reason;
  EXPECT_NEAR(fit.offset_s, -5.0, 4.0 * fit.offset_sigma_s);
  EXPECT_LT(fit.offset_sigma_s, 1e-3);
  EXPECT_NEAR(fit.drift, 0.0, 4.0 * fit.drift_sigma);
}

TEST(AlignClocks, OtherKnocksAreNoAgreement) {
  const ImportStreams one = knocked_body({3.3, 4.9, 56.2}, 60.0, 1), other = knocked_body({7.0, 9.9, 31.5}, 60.0, 2);
  EXPECT_THAT(align_clocks(one.pose, {}, other.specific_force, kUps).reason, HasSubstr("do not agree"));
  const ImportStreams still = knocked_body({}, 20.0, 3);
  EXPECT_FALSE(align_clocks(still.pose, {}, still.specific_force, kUps).is_determined);
  EXPECT_FALSE(align_clocks(still.pose, {}, one.specific_force, kUps).is_determined);
}

}  // namespace
}  // namespace asperity
