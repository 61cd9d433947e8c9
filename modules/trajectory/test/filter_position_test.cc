#include "asperity/trajectory/filter_position.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "asperity/base/error.h"
#include "asperity/base/random.h"
#include "asperity/signal/statistics.h"

namespace asperity {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

std::vector<Eigen::Vector3d> noisy_path(std::size_t n) {
  Random random(1);
  std::vector<Eigen::Vector3d> z;
  for (std::size_t i = 0; i < n; ++i) {
    const double t = 0.005 * static_cast<double>(i);
    z.push_back(Eigen::Vector3d(0.025 * t, 0.01 * std::sin(t), 0.4) +
                1e-4 * Eigen::Vector3d(random.normal(), random.normal(), random.normal()));
  }
  return z;
}

// The matrices as the seed prints them, with general algebra (seed §4.2, A.3).
TEST(FilterPosition, AgreesWithThePrintedMatrices) {
  PositionFilterNoise noise;
  noise.process_position_m2 = {1e-10, 2e-10, 3e-10};
  noise.process_velocity_m2ps2 = {1e-7, 2e-7, 1e-6};
  noise.measurement_m2 = {2e-8, 1e-8, 3e-7};
  noise.initial_velocity_m2ps2.setConstant(1e-2);
  const double dt = 0.005;
  const auto z = noisy_path(500);
  const FilteredPosition filtered = filter_position(z, dt, noise);

  Matrix6 F = Matrix6::Identity();
  F.topRightCorner<3, 3>() = dt * Eigen::Matrix3d::Identity();
  Eigen::Matrix<double, 3, 6> H = Eigen::Matrix<double, 3, 6>::Zero();
  H.leftCols<3>().setIdentity();
  Matrix6 Q = Matrix6::Zero();
  Q.diagonal() << noise.process_position_m2, noise.process_velocity_m2ps2;
  const Eigen::Matrix3d R = noise.measurement_m2.asDiagonal();
  Vector6 x;
  x << z[0], Eigen::Vector3d::Zero();
  Matrix6 P = Matrix6::Zero();
  P.diagonal() << noise.measurement_m2, noise.initial_velocity_m2ps2;
  for (std::size_t i = 1; i < z.size(); ++i) {
    x = F * x;
    P = F * P * F.transpose() + Q;
    const Eigen::Matrix<double, 6, 3> K = P * H.transpose() * (H * P * H.transpose() + R).inverse();
    x += K * (z[i] - H * x);
    P = (Matrix6::Identity() - K * H) * P;
    EXPECT_NEAR((filtered.p_m[i] - x.head<3>()).norm(), 0.0, 1e-13);  // of 0.4 m
    EXPECT_NEAR((filtered.v_mps[i] - x.tail<3>()).norm(), 0.0, 1e-12);
  }
}

// Without process noise and with a vague start the filter is recursive least squares of a line.
TEST(FilterPosition, WithoutProcessNoiseItIsTheLineOfLeastSquares) {
  PositionFilterNoise noise;
  noise.measurement_m2.setConstant(1e-8);
  noise.initial_velocity_m2ps2.setConstant(1e6);
  const auto z = noisy_path(300);
  const FilteredPosition filtered = filter_position(z, 0.005, noise);
  std::vector<double> t, x;
  for (std::size_t i = 0; i < z.size(); ++i) {
    t.push_back(0.005 * static_cast<double>(i));
    x.push_back(z[i].x());
    if (i < 10) continue;
    const LinearFit fit = linear_regression(t, x);
    EXPECT_NEAR(filtered.v_mps[i].x(), fit.slope, 1e-9);
    EXPECT_NEAR(filtered.p_m[i].x(), fit.intercept + fit.slope * t.back(), 1e-11);
  }
}

TEST(FilterPosition, RejectsWhatHasNoMeaning) {
  const auto z = noisy_path(3);
  EXPECT_THROW(filter_position(z, 0.0, {}), Error);
  PositionFilterNoise noise;
  noise.measurement_m2.z() = 0.0;
  EXPECT_THROW(filter_position(z, 0.005, noise), Error);
  EXPECT_TRUE(filter_position({}, 0.005, {}).p_m.empty());
}

}  // namespace
}  // namespace asperity
