#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "asperity/base/error.h"
#include "asperity/base/random.h"
#include "asperity/geometry/fit_circle.h"
#include "asperity/geometry/fit_plane.h"

namespace asperity {
namespace {

TEST(FitPlane, FindsAKnownPlane) {
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, -0.5).normalized()));
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 40; ++i)
    points.push_back(turn * Eigen::Vector3d(0.1 * i, std::sin(0.3 * i), 0.0) + Eigen::Vector3d(3, 4, 5));
  const PlaneFit fit = fit_plane(points);
  EXPECT_NEAR(std::abs(fit.normal().dot(turn * Eigen::Vector3d::UnitZ())), 1.0, 1e-14);
  EXPECT_NEAR(fit.rms_m, 0.0, 1e-14);
  EXPECT_NEAR(fit.axes.determinant(), 1.0, 1e-12);
}

TEST(FitPlane, StandardErrorsAreTheSpreadOfRepeatedFits) {
  Random random(3);
  double square = 0.0, predicted = 0.0;
  constexpr int kRuns = 400;
  for (int run = 0; run < kRuns; ++run) {
    std::vector<Eigen::Vector3d> points;
    for (int i = 0; i < 60; ++i) {
      points.emplace_back(random.uniform(-0.1, 0.1), random.uniform(-0.02, 0.02), 1e-4 * random.normal());
    }
    const PlaneFit fit = fit_plane(points);
    square += std::pow(fit.normal().y() / fit.normal().z(), 2);
    predicted += fit.tilt_stderr_rad.y() * fit.tilt_stderr_rad.y();
  }
  EXPECT_NEAR(std::sqrt(square / predicted), 1.0, 0.12);  // 400 runs: 3.5 % standard error of a standard deviation
}

TEST(FitPlane, PointsOnALineLeaveOneTiltOpen) {
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 10; ++i) points.emplace_back(i, 0.0, 0.0);
  EXPECT_TRUE(std::isinf(fit_plane(points).tilt_stderr_rad.y()));
  EXPECT_THROW(fit_plane(std::vector<Eigen::Vector3d>(2)), Error);
  points[3].x() = NAN;
  EXPECT_THROW(fit_plane(points), Error);
}

TEST(FitPlane, ZeroWeightsDropPoints) {
  std::vector<Eigen::Vector3d> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {5, 5, 5}};
  EXPECT_NEAR(std::abs(fit_plane(points, std::vector<double>{1, 1, 1, 1, 0}).normal().z()), 1.0, 1e-14);
}

TEST(FitCircle, FindsKnownCirclesFromShortArcsToWholeTurns) {
  for (const double angle : {0.05, 0.5, 2.0, 6.2}) {
    std::vector<Eigen::Vector2d> points;
    for (int i = 0; i < 50; ++i) {
      const double a = 0.7 + angle * i / 49.0;
      points.emplace_back(3.0 + 0.04 * std::cos(a), -2.0 + 0.04 * std::sin(a));
    }
    const CircleFit fit = fit_circle(points);
    EXPECT_TRUE(fit.converged);
    EXPECT_NEAR(fit.radius_m, 0.04, 1e-9) << angle;
    EXPECT_NEAR((fit.centre_m - Eigen::Vector2d(3.0, -2.0)).norm(), 0.0, 1e-9) << angle;
  }
}

TEST(FitCircle, StandardErrorIsTheSpreadOfRepeatedFits) {
  Random random(4);
  double square = 0.0, predicted = 0.0, sum = 0.0;
  constexpr int kRuns = 400;
  for (int run = 0; run < kRuns; ++run) {
    std::vector<Eigen::Vector2d> points;
    for (int i = 0; i < 80; ++i) {
      const double a = 1.2 * i / 79.0, r = 0.04 + 5e-5 * random.normal();
      points.emplace_back(r * std::cos(a), r * std::sin(a));
    }
    const CircleFit fit = fit_circle(points);
    sum += fit.radius_m - 0.04;
    square += std::pow(fit.radius_m - 0.04, 2);
    predicted += fit.radius_stderr_m() * fit.radius_stderr_m();
  }
  EXPECT_NEAR(std::sqrt(square / predicted), 1.0, 0.12);
  EXPECT_NEAR(sum / kRuns, 0.0, 4.0 * std::sqrt(predicted) / kRuns);  // no bias beyond four standard errors
}

TEST(FitCircle, StraightPointsHaveNoSignificantCurvature) {
  Random random(5);
  std::vector<Eigen::Vector2d> points;
  for (int i = 0; i < 60; ++i) points.emplace_back(0.001 * i, 2e-5 * random.normal());
  const CircleFit fit = fit_circle(points);
  EXPECT_TRUE(!fit.converged || 1.0 / fit.radius_m < 4.0 * fit.curvature_stderr_per_m());
  EXPECT_NEAR(fit.rms_m, 2e-5, 5e-6);
}

}  // namespace
}  // namespace asperity
