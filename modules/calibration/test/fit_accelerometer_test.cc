#include "asperity/calibration/fit_accelerometer.h"

#include <gmock/gmock.h>

#include "asperity/base/error.h"
#include "asperity/base/units.h"
#include "coverage.h"
#include "simulated_accelerometer.h"

namespace asperity {
namespace {

constexpr int kTrials = 200;

using test::SimulatedAccelerometer;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// Seed §3.5 prints this matrix in counts per g.
Eigen::Matrix3d seed_matrix() {
  Eigen::Matrix3d B;
  B << 53.4307, 15.5323, -7.0840, 11.8876, 6.9135, 53.1222, -21.1769, -55.6179, -8.5817;
  return B / kStandardGravity_mps2;
}

SimulatedAccelerometer seed_sensor() {
  SimulatedAccelerometer out;
  out.B = seed_matrix();
  out.C = {110.6883, 120.6481, 122.0551};
  out.drift_counts = 0.3;
  out.noise_counts = 0.5;
  return out;
}

std::vector<Eigen::Vector3d> forces(int count, double least_mps2, double most_mps2, Random& random) {
  std::vector<Eigen::Vector3d> out;
  for (int i = 0; i < count; ++i) out.push_back(random.uniform(least_mps2, most_mps2) * test::random_direction(random));
  return out;
}

std::string message_of(const AccelerometerSamples& samples, const FitAccelerometerConfig& config = {}) {
  try {
    fit_accelerometer(samples, config);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

void add_model(test::Coverage& coverage, const AccelerometerCalibration& found, const Eigen::MatrixXd& B,
               const Eigen::Vector3d& C) {
  for (int axis = 0; axis < 3; ++axis) {
    const std::string letter(1, "ijk"[axis]);
    const Eigen::Index width = found.B.cols();
    for (Eigen::Index k = 0; k < width; ++k) {
      if (found.standard_errors(axis, k) == 0.0) continue;
      coverage.add("B " + letter + std::to_string(k), found.B(axis, k), B(axis, k), found.standard_errors(axis, k));
    }
    coverage.add("C " + letter, found.C[axis], C[axis], found.standard_errors(axis, width));
  }
}

TEST(FitAccelerometer, TwoHundredLinearFitsUnderGravityKeepTheirErrors) {
  test::Coverage coverage;
  int linear = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    Random random(31, static_cast<std::uint64_t>(trial));
    const SimulatedAccelerometer sensor = seed_sensor();
    const double g = kStandardGravity_mps2;
    const AccelerometerFit fit = fit_accelerometer(test::place_in(forces(30, g, g, random), sensor, random));
    EXPECT_EQ(fit.poses, 30U);
    add_model(coverage, fit.models[1].accelerometer, sensor.B, sensor.C);
    linear += fit.accelerometer.model == AccelerometerModel::kLinear ? 1 : 0;
  }
  coverage.expect("accelerometer under a known force, linear, 30 poses", kTrials);
  EXPECT_GE(linear, 180) << "Schwarz's criterion finds the model that the data came from";
}

TEST(FitAccelerometer, TwoHundredScalarOffsetFitsKeepTheirErrors) {
  test::Coverage coverage;
  for (int trial = 0; trial < kTrials; ++trial) {
    Random random(32, static_cast<std::uint64_t>(trial));
    SimulatedAccelerometer sensor = seed_sensor();
    sensor.B << 5.5, 0, 0, 0, 0, 5.4, 0, -5.7, 0;
    const double g = kStandardGravity_mps2;
    const AccelerometerFit fit = fit_accelerometer(test::place_in(forces(20, g, g, random), sensor, random));
    EXPECT_THAT(fit.marker_axis, ElementsAre(0, 2, 1));
    add_model(coverage, fit.models[0].accelerometer, sensor.B, sensor.C);
  }
  coverage.expect("accelerometer under a known force, scalar and offset, 20 poses", kTrials);
}

TEST(FitAccelerometer, TwoHundredQuadricFitsKeepTheirErrors) {
  test::Coverage coverage;
  int quadric = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    Random random(33, static_cast<std::uint64_t>(trial));
    const SimulatedAccelerometer sensor = seed_sensor();
    Eigen::Matrix<double, 3, 9> B = Eigen::Matrix<double, 3, 9>::Zero();
    B.leftCols<3>() = sensor.B;
    for (int axis = 0; axis < 3; ++axis) {
      for (int k = 3; k < 9; ++k) B(axis, k) = random.uniform(-0.03, 0.03);
    }
    AccelerometerCalibration bent;
    bent.model = AccelerometerModel::kQuadric;
    bent.B = B;
    auto samples = test::place_in(forces(60, 3.0, 18.0, random), sensor, random);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const Eigen::Vector3d& f = samples.specific_force_mps2[i];
      samples.counts[i] += bent.counts(f) - sensor.B * f;
    }
    const AccelerometerFit fit = fit_accelerometer(samples);
    ASSERT_EQ(fit.models.size(), 3U);
    EXPECT_THAT(fit.models[2].dropped, IsEmpty());
    add_model(coverage, fit.models[2].accelerometer, B, sensor.C);
    quadric += fit.accelerometer.model == AccelerometerModel::kQuadric ? 1 : 0;
  }
  coverage.expect("accelerometer under a known force, quadric, 60 forces", kTrials);
  EXPECT_GE(quadric, 180);
}

TEST(FitAccelerometer, GravityAloneDoesNotDetermineOneSquare) {
  Random random(2);
  const double g = kStandardGravity_mps2;
  const AccelerometerFit fit = fit_accelerometer(test::place_in(forces(60, g, g, random), seed_sensor(), random));
  ASSERT_EQ(fit.models.size(), 3U);
  EXPECT_THAT(fit.models[2].dropped, ElementsAre("z²"));
  EXPECT_EQ(fit.models[2].parameters, 9);
  EXPECT_TRUE((fit.models[2].accelerometer.B.col(5).array() == 0.0).all());
  EXPECT_EQ(fit.accelerometer.model, AccelerometerModel::kLinear) << fit.reason;
  EXPECT_THAT(fit.reason, HasSubstr("linear has the lowest"));
  // The seed's sensor lies askew, so one factor an axis is far off (Fig. 12).
  EXPECT_GT(fit.models[0].accelerometer.residual_counts.minCoeff(),
            5.0 * fit.models[1].accelerometer.residual_counts.maxCoeff());
  EXPECT_LT(fit.models[1].better_probability, 1e-9);
  EXPECT_TRUE(fit.verdict.trustworthy) << fit.verdict.text;
}

// The errors of rows, taken as independent, would be wrong by the root of the rows in a pose.
TEST(FitAccelerometer, MoreRowsAPoseDoNotMakeItMorePrecise) {
  Random random(8);
  SimulatedAccelerometer sensor = seed_sensor();
  sensor.drift_counts = 2.0;
  const double g = kStandardGravity_mps2;
  const auto held = forces(24, g, g, random);
  Random same(77);
  const AccelerometerFit fit = fit_accelerometer(test::place_in(held, sensor, same));
  EXPECT_EQ(fit.rows, 24U * 40U);
  EXPECT_EQ(fit.models[1].degrees_of_freedom, 20);
  EXPECT_NEAR(fit.models[1].accelerometer.residual_counts.mean(), 2.0, 0.5);
}

// A sensor that drifts like a random walk while it is turned slowly, as in the seed, without ever stopping.
TEST(FitAccelerometer, SlowTurnsWithDriftingErrorsKeepTheirErrors) {
  test::Coverage coverage;
  for (int trial = 0; trial < kTrials; ++trial) {
    Random random(34, static_cast<std::uint64_t>(trial));
    const SimulatedAccelerometer sensor = seed_sensor();
    AccelerometerSamples samples;
    Eigen::Vector3d drift = Eigen::Vector3d::Zero();
    const double phase = random.uniform(0.0, 6.28);
    for (int i = 0; i < 6000; ++i) {
      const double t_s = 0.05 * i;
      const double tilt = std::acos(std::sin(0.031 * t_s + phase));
      const double turn = 0.43 * t_s + phase;
      const Eigen::Vector3d f =
          kStandardGravity_mps2 *
          Eigen::Vector3d(std::sin(tilt) * std::cos(turn), std::sin(tilt) * std::sin(turn), std::cos(tilt));
      // A first-order process with a memory of one second.
      drift = 0.95 * drift + 0.3 * std::sqrt(1.0 - 0.95 * 0.95) * sensor.draw_drift(random) / 0.3;
      samples.t_s.push_back(t_s);
      samples.specific_force_mps2.push_back(f);
      samples.counts.push_back(sensor.read(f, drift, random));
    }
    const AccelerometerFit fit = fit_accelerometer(samples);
    add_model(coverage, fit.models[1].accelerometer, sensor.B, sensor.C);
  }
  coverage.expect("accelerometer under a known force, turned slowly, correlated errors", kTrials);
}

// Each direction with its opposite next to it, and errors that last from pose to pose: averaged in pairs the forces
// would be nothing. The poses determine the model all the same; only their errors are not independent.
TEST(FitAccelerometer, OppositePosesInARowAreNotAveragedAway) {
  Random random(9);
  SimulatedAccelerometer sensor = seed_sensor();
  sensor.drift_counts = 0.0;
  AccelerometerSamples samples;
  Eigen::Vector3d drift = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction;
  for (int pose = 0; pose < 64; ++pose) {
    if (pose % 2 == 0) direction = test::random_direction(random);
    drift = 0.9 * drift + 2.0 * test::random_direction(random);
    const Eigen::Vector3d f = (pose % 2 == 0 ? 1.0 : -1.0) * kStandardGravity_mps2 * direction;
    for (int i = 0; i < 40; ++i) {
      samples.t_s.push_back(static_cast<double>(samples.size()) / sensor.rate_Hz);
      samples.counts.push_back(sensor.read(f, drift, random));
      samples.specific_force_mps2.push_back(f);
    }
  }
  const AccelerometerFit fit = fit_accelerometer(samples);
  EXPECT_EQ(fit.joined, 1U);
  EXPECT_EQ(fit.poses, 64U);
  EXPECT_GT(fit.correlation, 0.5);
  EXPECT_EQ(verdict_word(fit.verdict.verdicts), "limited");
  EXPECT_THAT(fit.verdict.text, HasSubstr("neighbouring poses are alike"));
}

TEST(FitAccelerometer, RefusesDirectionsThatDetermineNothing) {
  Random random(5);
  const SimulatedAccelerometer sensor = seed_sensor();
  const double g = kStandardGravity_mps2;
  std::vector<Eigen::Vector3d> upright;
  for (int i = 0; i < 20; ++i) {
    upright.push_back(g * Eigen::Vector3d(0.3 * random.normal(), 0.3 * random.normal(), 3.0).normalized());
  }
  const std::string cone = message_of(test::place_in(upright, sensor, random), {.same_pose_mps2 = 1e-6});
  EXPECT_THAT(cone, HasSubstr("the marker's z axis"));
  EXPECT_THAT(cone, HasSubstr("z down"));
  EXPECT_THAT(message_of(test::place_in(forces(3, g, g, random), sensor, random)), HasSubstr("6 are needed"));
  EXPECT_THAT(message_of(test::place_in(std::vector<Eigen::Vector3d>(30, {0, 0, g}), sensor, random)),
              HasSubstr("1 poses"));
  SimulatedAccelerometer dead = sensor;
  dead.B.row(1).setZero();
  dead.drift_counts = 0.0;
  EXPECT_THAT(message_of(test::place_in(forces(30, g, g, random), dead, random)), HasSubstr("dead"));
  FitAccelerometerConfig quadric;
  quadric.model = AccelerometerChoice::kQuadric;
  EXPECT_THAT(message_of(test::place_in(forces(8, g, g, random), sensor, random), quadric), HasSubstr("quadric"));
}

}  // namespace
}  // namespace asperity
