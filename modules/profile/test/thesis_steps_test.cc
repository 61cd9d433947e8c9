#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "asperity/base/error.h"
#include "asperity/base/random.h"
#include "asperity/profile/thesis_steps.h"

namespace asperity {
namespace {

const double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(BlendAcceleration, KeepsTheSign) {
  const std::vector<Eigen::Vector3d> n(3, Eigen::Vector3d(0.0, -0.6, 0.8));
  const std::vector<Eigen::Vector3d> a{{7.0, 0.0, 1.0}, {0.0, 1.0, 0.0}, {3.0, 0.8, 0.6}};
  const auto a_n = blend_acceleration(a, n);
  EXPECT_DOUBLE_EQ(a_n[0], 0.8);
  EXPECT_DOUBLE_EQ(a_n[1], -0.6);
  EXPECT_NEAR(a_n[2], 0.0, 1e-15);
  EXPECT_THROW(blend_acceleration(a, std::vector<Eigen::Vector3d>(2)), Error);
}

// Mean 2, range 2: the printed formula by hand (seed §4.4).
TEST(ForceScale, IsThePrintedFormula) {
  EXPECT_EQ(force_scale(std::vector<double>{1.0, 2.0, 3.0}, 0), (std::vector<double>{1.5, 1.0, 0.5}));
  EXPECT_EQ(force_scale(std::vector<double>{1.0, kNan, 3.0}, 0), (std::vector<double>{1.5, 1.0, 0.5}));
}

TEST(ForceScale, ConstantOrAbsentForceGivesOne) {
  const std::vector<double> ones(5, 1.0);
  EXPECT_EQ(force_scale(std::vector<double>(5, 0.7), 1), ones);
  EXPECT_EQ(force_scale(std::vector<double>(5, kNan), 1), ones);
  EXPECT_TRUE(force_scale({}, 1).empty());
}

TEST(ForceScale, TheMovingAverageCalmsNoise) {
  Random random(1);
  std::vector<double> force_N(4000);
  for (std::size_t i = 0; i < force_N.size(); ++i) {
    force_N[i] = 1.0 + 1e-3 * static_cast<double>(i) + 0.5 * random.normal();
  }
  const auto scale = force_scale(force_N, 100);
  // A ramp from 1 to 5 N: from 1.5 to 0.5 in a straight line, within the mean of 201 values of 0.5 N, 4 sigma.
  for (std::size_t i = 200; i < 3800; ++i) {
    EXPECT_NEAR(scale[i], 1.5 - static_cast<double>(i) / 4000.0, 0.05);
  }
}

// The scheme as printed with erratum 2, where it has not yet lost digits.
TEST(IntegrateVerlet, IsTheTextbookSchemeOnShortData) {
  Random random(2);
  const double dt = 0.005;
  std::vector<double> a(200);
  for (double& v : a) v = random.normal();
  const auto h = integrate_verlet(a, dt);
  std::vector<double> printed{0.0, 0.5 * a[0] * dt * dt};
  for (std::size_t i = 1; i + 1 < a.size(); ++i) {
    printed.push_back(2.0 * printed[i] - printed[i - 1] + a[i] * dt * dt);
  }
  ASSERT_EQ(h.size(), printed.size());
  for (std::size_t i = 0; i < h.size(); ++i) EXPECT_NEAR(h[i], printed[i], 1e-14);
}

TEST(IntegrateVerlet, ConstantAccelerationIsExactOverAMillionSamples) {
  const double dt = 0.005;
  const std::vector<double> a(1'000'000, 0.3);
  const auto h = integrate_verlet(a, dt);
  for (const std::size_t i : {1u, 2u, 1000u, 999'999u}) {
    const double t = dt * static_cast<double>(i);
    EXPECT_NEAR(h[i] / (0.5 * 0.3 * t * t), 1.0, 1e-9) << i;  // 10⁶ roundings; the textbook form is left with 1e-5
  }
}

// a = -A ω² sin ωt from rest gives A (sin ωt - ωt); the scheme's own error is (ω Δt)²/12 of the sine.
TEST(IntegrateVerlet, SineOverAMillionSamples) {
  const double dt = 1e-3;
  const double omega = 2.0 * M_PI * 10.0;
  const double amplitude_m = 1e-4;
  std::vector<double> a(1'000'000);
  for (std::size_t i = 0; i < a.size(); ++i) {
    a[i] = -amplitude_m * omega * omega * std::sin(omega * dt * static_cast<double>(i));
  }
  const auto h = integrate_verlet(a, dt);
  // Discretely: step response of the exact difference equation, h = k (A sin ωt - drift · t).
  const double k = std::pow(omega * dt / (2.0 * std::sin(0.5 * omega * dt)), 2);
  for (std::size_t i = 0; i < h.size(); i += 997) {
    const double t = dt * static_cast<double>(i);
    const double expected = k * amplitude_m * (std::sin(omega * t) - std::sin(omega * dt) * static_cast<double>(i));
    EXPECT_NEAR(h[i], expected, 1e-10 * (1.0 + std::abs(expected))) << i;
  }
  EXPECT_THROW(integrate_verlet(a, 0.0), Error);
  EXPECT_TRUE(integrate_verlet({}, 1.0).empty());
}

TEST(MarkStickSlip, CountsOnlyTheSpeedAlongTheSurface) {
  const std::vector<Eigen::Vector3d> n(4, Eigen::Vector3d::UnitZ());
  const std::vector<Eigen::Vector3d> v{{0.004, 0.0, 0.5}, {0.003, 0.004, 0.0}, {0.0, -0.02, 0.1}, {0.0, 0.0, 0.0}};
  EXPECT_EQ(mark_stick_slip(v, n, 0.005), (std::vector<char>{0, 1, 1, 0}));
  EXPECT_THROW(mark_stick_slip(v, std::vector<Eigen::Vector3d>(1), 0.005), Error);
}

TEST(PathLength, SumsTheSegments) {
  const std::vector<Eigen::Vector3d> p{{0, 0, 0}, {3, 4, 0}, {3, 4, 0}, {3, 4, -2}};
  EXPECT_EQ(path_length_m(p), (std::vector<double>{0.0, 5.0, 5.0, 7.0}));
  EXPECT_TRUE(path_length_m({}).empty());
}

}  // namespace
}  // namespace asperity
