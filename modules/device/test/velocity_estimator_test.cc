#include "asperity/device/velocity_estimator.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace asperity {
namespace {

constexpr double kTick_s = 1e-3;
constexpr double kStep_m = 50e-6;  // of an encoder

double quantised(double x_m) { return std::round(x_m / kStep_m) * kStep_m; }

TEST(VelocityEstimator, ExactOnAStraightLine) {
  VelocityEstimator state;
  const Eigen::Vector3d v_mps(0.1, -0.02, 0.003);
  EXPECT_EQ(estimate_velocity(state, Eigen::Vector3d::Zero(), 1, 0.0, 1e-5), Eigen::Vector3d::Zero());
  for (std::uint64_t k = 1; k < 40; ++k) {
    const double t_s = kTick_s * static_cast<double>(k);
    EXPECT_LT((estimate_velocity(state, v_mps * t_s, k + 1, t_s, 1e-5) - v_mps).norm(), 1e-12);
  }
}

// 10 mm/s seen through steps of 50 µm: differences of one tick are 0 or 50 mm/s, the window averages 15 ticks.
TEST(VelocityEstimator, SmoothsQuantisation) {
  VelocityEstimator state;
  double worst = 0.0;
  for (std::uint64_t k = 0; k < 500; ++k) {
    const double t_s = kTick_s * static_cast<double>(k);
    const double v = estimate_velocity(state, Eigen::Vector3d(quantised(0.01 * t_s), 0.0, 0.0), k, t_s, kStep_m).x();
    if (k > 20) worst = std::max(worst, std::abs(v - 0.01));
  }
  EXPECT_LT(worst, 1.01 * kStep_m / (15.0 * kTick_s));
}

// A reversal from +0.2 to −0.2 m/s is seen within two ticks: the long window no longer fits.
TEST(VelocityEstimator, FollowsAReversal) {
  VelocityEstimator state;
  const auto path = [](int k) { return 0.2 * kTick_s * (k <= 50 ? k : 100 - k); };
  double v = 0.0;
  for (int k = 0; k <= 52; ++k) {
    v = estimate_velocity(state, Eigen::Vector3d(path(k), 0.0, 0.0), static_cast<std::uint64_t>(k), kTick_s * k,
                          kStep_m)
            .x();
  }
  EXPECT_NEAR(v, -0.2, 1e-9);
}

TEST(VelocityEstimator, KeepsItsVelocityWithoutNewsAndForgetsAfterNan) {
  VelocityEstimator state;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  estimate_velocity(state, Eigen::Vector3d::Zero(), 1, 0.0, 1e-5);
  const Eigen::Vector3d v_mps = estimate_velocity(state, Eigen::Vector3d(1e-3, 0.0, 0.0), 2, 0.01, 1e-5);
  EXPECT_NEAR(v_mps.x(), 0.1, 1e-12);
  EXPECT_EQ(estimate_velocity(state, Eigen::Vector3d(1e-3, 0.0, 0.0), 2, 0.011, 1e-5), v_mps);
  EXPECT_EQ(estimate_velocity(state, Eigen::Vector3d::Constant(nan), 3, 0.012, 1e-5), Eigen::Vector3d::Zero());
  EXPECT_EQ(estimate_velocity(state, Eigen::Vector3d::Zero(), 4, 0.013, 1e-5), Eigen::Vector3d::Zero());
}

}  // namespace
}  // namespace asperity
