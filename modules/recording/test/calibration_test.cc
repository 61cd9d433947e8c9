#include "asperity/recording/calibration.h"

#include <gmock/gmock.h>

#include "asperity/base/error.h"
#include "random_recording.h"

namespace asperity {
namespace {

constexpr double kTol_mps2 = 1e-9;  // roundings of counts near 1e4 over slopes near 400 counts per m/s²

AccelerometerCalibration quadric() {
  AccelerometerCalibration out;
  out.model = AccelerometerModel::kQuadric;
  out.B = Eigen::Matrix<double, 3, Eigen::Dynamic>::Zero(3, 9);
  out.B << 400, 5, -3, 0.4, 0.1, -0.2, 0.05, 0.02, -0.03,  //
      2, 410, 7, -0.1, 0.3, 0.1, 0.01, 0.04, 0.02,         //
      -4, 1, 395, 0.2, -0.2, 0.5, -0.02, 0.03, 0.06;
  out.C = {30000, 31000, 33000};
  return out;
}

TEST(Calibration, CountsAreTheModelAsWritten) {
  const AccelerometerCalibration model = quadric();
  // By hand: φ(1, 2, 3) = (1, 2, 3, 1, 4, 9, 2, 3, 6); row 0: 400+10-9 +0.4+0.4-1.8 +0.1+0.06-0.18.
  EXPECT_NEAR(model.counts({1.0, 2.0, 3.0})[0], 30000.0 + 399.98, 1e-9);
}

TEST(Calibration, InverseUndoesTheModel) {
  Random random(3);
  for (int i = 0; i < 500; ++i) {
    const Eigen::Vector3d f =
        40.0 * Eigen::Vector3d(random.normal(), random.normal(), random.normal()).cwiseMax(-2).cwiseMin(2);
    const AccelerometerCalibration square = quadric();
    EXPECT_NEAR((square.specific_force_mps2(square.counts(f)) - f).norm(), 0.0, kTol_mps2) << f.transpose();
    AccelerometerCalibration linear = quadric();
    linear.model = AccelerometerModel::kLinear;
    linear.B = Eigen::Matrix<double, 3, Eigen::Dynamic>(linear.B.leftCols<3>());
    EXPECT_NEAR((linear.specific_force_mps2(linear.counts(f)) - f).norm(), 0.0, kTol_mps2);
  }
}

TEST(Calibration, UnreachableCountsGiveTheNearestReachable) {
  // counts = 400 f − 0.5 f² tops out at f = 400 with 80000 counts.
  AccelerometerCalibration model;
  model.model = AccelerometerModel::kQuadric;
  model.B = Eigen::Matrix<double, 3, Eigen::Dynamic>::Zero(3, 9);
  model.B.leftCols<3>() = 400.0 * Eigen::Matrix3d::Identity();
  for (int i = 0; i < 3; ++i) model.B(i, 3 + i) = -0.5;
  const Eigen::Vector3d f = model.specific_force_mps2({90000.0, 0.0, 0.0});
  EXPECT_TRUE(f.allFinite());
  EXPECT_NEAR(model.counts(f)[0], 80000.0, 1.0);
}

TEST(Calibration, SingularIsAnError) {
  AccelerometerCalibration model;
  model.B = Eigen::Matrix<double, 3, Eigen::Dynamic>::Ones(3, 3);
  EXPECT_THROW(model.specific_force_mps2({1.0, 2.0, 3.0}), Error);
}

TEST(Calibration, ForceAxisPointsFromTheTipToTheHand) {
  Calibration calibration;
  calibration.tip_in_marker_m = {0.0, 0.0, -0.1};
  EXPECT_NEAR((calibration.force_axis_in_marker() - Eigen::Vector3d::UnitZ()).norm(), 0.0, 1e-15);
  calibration.force.axis_in_marker = Eigen::Vector3d(3.0, 0.0, 4.0);
  EXPECT_NEAR((calibration.force_axis_in_marker() - Eigen::Vector3d(0.6, 0.0, 0.8)).norm(), 0.0, 1e-15);
  calibration.force.axis_in_marker.reset();
  calibration.tip_in_marker_m.setZero();
  EXPECT_THROW(calibration.force_axis_in_marker(), Error);
}

TEST(Calibration, ForceOfTheSeedsFigure11) {
  // Seed Fig. 11: the line through ten points gives 3.33 N near 185 counts, where 3.54 N was measured.
  const ForceCalibration force{0.025095, -1.313768, 0.196, std::nullopt};
  EXPECT_NEAR(force.force_N(185.0), 3.54, 2.0 * 0.196);
}

}  // namespace
}  // namespace asperity
