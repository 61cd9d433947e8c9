#include "asperity/calibration/find_static_poses.h"

#include <gmock/gmock.h>

#include <fstream>

#include "asperity/base/error.h"
#include "asperity/calibration/calibrate_accelerometer_field.h"
#include "asperity/calibration/find_gyroscope_offset.h"
#include "asperity/calibration/read_accelerometer_samples.h"
#include "asperity/testkit/temp_dir.h"
#include "simulated_accelerometer.h"

namespace asperity {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const std::filesystem::path kData = ASPERITY_TEST_DATA;
constexpr double kGravity_mps2 = 9.80665;

test::SimulatedAccelerometer sensor_of(double scale, double noise_counts) {
  test::SimulatedAccelerometer out;
  out.B = scale * Eigen::Matrix3d::Identity();
  out.drift_counts = 0.0;
  out.noise_counts = noise_counts;
  return out;
}

std::string message_of(const std::filesystem::path& file) {
  try {
    read_accelerometer_samples(file);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(FindStaticPoses, FindsEveryRestOfSensorsFineAndCoarse) {
  for (const auto& [scale, noise] : {std::pair{415.0, 4.0}, {5.7, 0.5}, {5.7, 0.0}, {20000.0, 900.0}}) {
    Random random(7);
    std::vector<Eigen::Vector3d> held;
    for (int i = 0; i < 20; ++i)
      held.push_back(Eigen::AngleAxisd(1.1 * i, Eigen::Vector3d(1, 2, 3).normalized()) * Eigen::Vector3d::UnitX());
    const test::SimulatedAccelerometer sensor = sensor_of(scale, noise);
    const auto samples = test::hold_in(held, kGravity_mps2, sensor, random);
    const StaticPoses found = find_static_poses(samples);
    ASSERT_EQ(found.poses.size(), held.size()) << scale << " " << noise;
    for (std::size_t p = 0; p < held.size(); ++p) {
      // Within a degree of the direction held, so that no turn is in the mean.
      EXPECT_LT((found.poses[p].mean_counts / (scale * kGravity_mps2) - held[p]).norm(), 0.02);
      EXPECT_GT(found.poses[p].duration_s, 1.5);
    }
  }
}

TEST(FindStaticPoses, RowsLostInsideARestPartItAndAreNotHeldForStill) {
  AccelerometerSamples samples;
  Random random(3);
  for (int i = 0; i < 1000; ++i) {
    if (i >= 400 && i < 600) continue;
    samples.t_s.push_back(0.01 * i);
    samples.counts.emplace_back(random.normal() + (i < 400 ? 0.0 : 500.0), random.normal(), random.normal());
  }
  const StaticPoses found = find_static_poses(samples);
  ASSERT_EQ(found.poses.size(), 2U);
  EXPECT_LT(found.poses[0].start_s + found.poses[0].duration_s, 4.0);
  EXPECT_GE(found.poses[1].start_s, 6.0);
}

TEST(CalibrateAccelerometerField, AnXsensSensorByHand) {
  const AccelerometerFile file = read_accelerometer_samples(kData / "xsens" / "xsens_acc_10Hz.txt");
  EXPECT_THAT(file.notes, ElementsAre(HasSubstr("bare numbers")));
  AccelerometerFieldConfig config;
  config.gravity_mps2 = 9.81744;
  config.poses.window_s = 1.0;
  const AccelerometerFieldResult result = calibrate_accelerometer_field(file.samples, config);
  EXPECT_EQ(result.poses.size(), 38U);
  EXPECT_LT(result.rms_all_mps2, 2e-3);
  // The publishers of the data give about 415 counts per m/s².
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(result.scale_counts_per_mps2[axis], 415.0, 4.0);
  EXPECT_TRUE(result.verdict.trustworthy) << result.verdict.text;
}

TEST(ReadAccelerometerSamples, TablesWithAndWithoutAHeader) {
  const testkit::TempDir dir;
  const auto file = dir / "accel.csv";
  const auto write = [&](const std::string& text) { std::ofstream(file) << text; };
  write("t_s,accel_i,accel_j,accel_k\n0,1,2,3\n0.1,4,5,6\n0.1,7,8,9\n");
  const AccelerometerFile table = read_accelerometer_samples(file);
  EXPECT_EQ(table.samples.size(), 2U);
  EXPECT_FALSE(table.samples.force_known());
  EXPECT_THAT(table.notes, ElementsAre(HasSubstr("1 rows whose time does not rise")));
  write("t_s,accel_i,accel_j,accel_k,fx_mps2,fy_mps2,fz_mps2\n0,1,2,3,0,0,9.8\n");
  EXPECT_TRUE(read_accelerometer_samples(file).samples.force_known());
  write("0, 1, 2, 3\n0.1 4\t5 6\n");
  EXPECT_EQ(read_accelerometer_samples(file).samples.counts[1], Eigen::Vector3d(4, 5, 6));
  write("t_s,accel_i,accel_j,accel_k,fx_mps2\n0,1,2,3,0\n");
  EXPECT_THAT(message_of(file), HasSubstr("fy_mps2"));
  write("0 1 2 3\n0.1 4 5\n");
  EXPECT_THAT(message_of(file), HasSubstr("accel.csv:2: expected four numbers"));
  write("0 1 2 3\n0.1 4 5 nan\n");
  EXPECT_THAT(message_of(file), HasSubstr("accel.csv:2"));
  write("t_s,accel_i,accel_j,accel_k\n0,1,x,3\n");
  EXPECT_THAT(message_of(file), HasSubstr("accel.csv:2: column 'accel_j'"));
}

TEST(AccelerometerSamplesOf, LeavesOutRowsAtTheConvertersLimits) {
  Recording recording;
  recording.info.adc_min = 0;
  recording.info.adc_max = 255;
  recording.probe.t_ns = {1'000'000'000, 1'002'000'000, 1'004'000'000};
  recording.probe.accel_counts = {{1, 2, 3}, {255, 2, 3}, {4, 5, 6}};
  const AccelerometerFile file = accelerometer_samples_of(recording);
  EXPECT_THAT(file.samples.t_s, ElementsAre(0.0, testing::DoubleNear(0.004, 1e-12)));
  EXPECT_THAT(file.notes, ElementsAre(HasSubstr("1 rows at the converter's limits")));
}

TEST(FindGyroscopeOffset, IsTheMeanOverRestsWithADriftsError) {
  Recording recording;
  Random random(12);
  std::vector<StaticPose> poses;
  const Eigen::Vector3d offset(12.0, -7.0, 3.0);
  Eigen::Vector3d drift = Eigen::Vector3d::Zero();
  for (int i = 0; i < 20000; ++i) {
    const int pose = i / 1000;
    const bool still = i % 1000 >= 500;
    if (i % 1000 == 500) {
      drift = 2.0 * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
      StaticPose at;
      at.start_s = 0.001 * i;
      at.duration_s = 0.499;
      poses.push_back(at);
    }
    recording.probe.t_ns.push_back(std::int64_t{5'000'000'000} + std::int64_t{1'000'000} * i);
    recording.probe.gyro_counts.push_back(still
                                              ? Eigen::Vector3d(offset + drift + Eigen::Vector3d(0, 0, random.normal()))
                                              : Eigen::Vector3d(1000.0 + pose, 0.0, 0.0));
  }
  const auto found = find_gyroscope_offset(recording, poses);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->poses, 20U);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(found->counts[axis], offset[axis], 3.5 * found->stderr_counts[axis]);
    EXPECT_NEAR(found->stderr_counts[axis], 2.0 / std::sqrt(20.0), 0.2);
  }
  EXPECT_FALSE(find_gyroscope_offset(recording, {poses[0], poses[1]}));
}

}  // namespace
}  // namespace asperity
