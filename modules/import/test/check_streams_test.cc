#include "asperity/import/check_streams.h"

#include <gmock/gmock.h>
#include <numbers>

#include "asperity/base/error.h"
#include "known_motion.h"

namespace asperity {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing_import::known_motion;

constexpr double kDegree = std::numbers::pi / 180.0;

// The only doubt that there is.
ImportDoubt only_doubt(const ImportStreams& streams, const StreamUnits& units = {}) {
  const StreamChecks checks = check_streams(streams, units);
  EXPECT_EQ(checks.doubts.size(), 1u);
  return checks.doubts.empty() ? ImportDoubt{} : checks.doubts.front();
}

std::string options(const ImportDoubt& doubt) {
  std::string out;
  for (const StatedSetting& setting : doubt.settings) out += (out.empty() ? "" : " ") + as_option(setting);
  return out;
}

TEST(CheckStreams, FindsNoFaultWithARightMotion) {
  const StreamChecks checks = check_streams(known_motion());
  EXPECT_THAT(checks.doubts, IsEmpty());
  EXPECT_NEAR(checks.rest_mps2, 9.81, 1e-3);
  EXPECT_NEAR(checks.rate_ratio, 1.0, 1e-2);  // means over 40 ms of a rotation about a moving axis
  EXPECT_GT(checks.rate_cosine, 0.999);
  EXPECT_NEAR(checks.scale, 1.0, 0.02);
}

TEST(CheckStreams, NamesUnitsThatCannotBe) {
  const ImportStreams right = known_motion();
  const auto scaled = [&](double force, double rate, double position) {
    ImportStreams out = right;
    for (auto& f : out.specific_force.value) f *= force;
    for (auto& omega : out.rate.value) omega *= rate;
    for (auto& pose : out.pose.T_world_body) pose.translation_m *= position;
    return out;
  };
  EXPECT_EQ(only_doubt(scaled(1.0 / 9.80665, 1.0, 1.0)).unit, "g");  // g read as m/s²
  EXPECT_EQ(only_doubt(scaled(1000.0 / 9.80665, 1.0, 1.0)).unit, "mg");
  StreamUnits units;
  units.acceleration = "g";
  EXPECT_EQ(only_doubt(scaled(9.80665, 1.0, 1.0), units).unit, "m/s2");
  EXPECT_THAT(only_doubt(scaled(16384.0 / 9.80665, 1.0, 1.0)).message,
              HasSubstr("counts; state their scale, about 1/163"));
  EXPECT_EQ(only_doubt(scaled(1.0, 1.0 / kDegree, 1.0)).unit, "deg/s");
  units = {};
  units.rate = "deg/s";
  EXPECT_EQ(only_doubt(scaled(1.0, kDegree, 1.0), units).unit, "rad/s");
  EXPECT_EQ(only_doubt(scaled(1.0, 1.0, 1000.0)).unit, "mm");
  units = {};
  units.position = "mm";
  const ImportDoubt metres = only_doubt(scaled(1.0, 1.0, 1e-3), units);
  EXPECT_EQ(metres.unit, "m");
  EXPECT_EQ(metres.group, ColumnGroup::kPosition);
}

TEST(CheckStreams, SeesThatGravityHasBeenTakenOut) {
  ImportStreams streams = known_motion();
  for (std::size_t i = 0; i < streams.specific_force.size(); ++i) {
    const double t = 1e-9 * static_cast<double>(streams.specific_force.t_ns[i]);
    streams.specific_force.value[i] -= testing_import::rotation_at(t).conjugate() * Eigen::Vector3d(0.0, 0.0, 9.81);
  }
  EXPECT_THAT(only_doubt(streams).message, HasSubstr("gravity has been taken out"));
}

TEST(CheckStreams, NamesTimesThatCannotBe) {
  ImportStreams slow = known_motion(), fast = known_motion();
  for (auto& t : slow.pose.t_ns) t *= 1000;
  for (auto& t : fast.specific_force.t_ns) t /= 1000;
  EXPECT_EQ(only_doubt(slow).unit, "ms");
  StreamUnits units;
  units.imu_time = "ms";
  const ImportDoubt doubt = only_doubt(fast, units);
  EXPECT_EQ(doubt.unit, "s");
  EXPECT_EQ(doubt.role, FileRole::kImu);
}

TEST(CheckStreams, NamesAxesThatAreNotTheBodys) {
  ImportStreams streams = known_motion();
  // The body's x, y, z are the sensor's y, −x, z: the sensor's x is the body's −y.
  Eigen::Matrix3d R_body_sensor = sensor_axes("y,-x,z");
  for (auto& omega : streams.rate.value) omega = R_body_sensor.transpose() * omega;
  for (auto& f : streams.specific_force.value) f = R_body_sensor.transpose() * f;
  EXPECT_EQ(options(only_doubt(streams)), "--imu-axes y,-x,z");
  turn_sensor(streams, R_body_sensor);
  EXPECT_THAT(check_streams(streams).doubts, IsEmpty());

  const Eigen::Quaterniond tilt = exp_rotation({0.6, -0.5, 0.4});
  for (auto& omega : streams.rate.value) omega = tilt.conjugate() * omega;
  for (auto& f : streams.specific_force.value) f = tilt.conjugate() * f;
  const std::string setting = options(only_doubt(streams));
  ASSERT_THAT(setting, HasSubstr("--imu-axes 0."));
  const Eigen::Quaterniond found(sensor_axes(setting.substr(std::string("--imu-axes ").size())));
  EXPECT_LT(found.angularDistance(tilt), 0.01);
}

// The sensor's columns are `axes` of a right one's; mirrored rates change their sign where both rotate alike.
ImportStreams with_sensor(const Eigen::Matrix3d& force_axes, const Eigen::Matrix3d& rate_axes) {
  ImportStreams out = known_motion();
  for (auto& f : out.specific_force.value) f = force_axes.transpose() * f;
  for (auto& omega : out.rate.value) omega = rate_axes.transpose() * omega;
  return out;
}

TEST(CheckStreams, TellsAMirroredSensorFromAnExchangedOne) {
  const Eigen::Matrix3d mirror = sensor_axes("x,y,-z"), one = Eigen::Matrix3d::Identity();
  // A left-handed sensor whose rates follow the left hand: turned alike is −mirror.
  ImportStreams left = with_sensor(mirror, -mirror);
  EXPECT_EQ(options(only_doubt(left)), "--imu-axes x,y,-z");
  turn_sensor(left, mirror);
  EXPECT_THAT(check_streams(left).doubts, IsEmpty());
  // Rates alone with one sign wrong, or two columns exchanged: no rotation of the sensor explains it.
  EXPECT_EQ(only_doubt(with_sensor(one, mirror)).axes, "x,y,-z");
  EXPECT_EQ(only_doubt(with_sensor(one, sensor_axes("y,x,z"))).axes, "y,x,z");
  EXPECT_EQ(only_doubt(with_sensor(one, -one)).axes, "-x,-y,-z");
}

TEST(CheckStreams, ComparesTheAxesOfPositionsAndAccelerometer) {
  const Eigen::Matrix3d one = Eigen::Matrix3d::Identity();
  for (const char* axes : {"y,x,z", "-x,y,z", "-x,-y,-z", "z,x,y"}) {
    const ImportDoubt doubt = only_doubt(with_sensor(sensor_axes(axes), one));
    EXPECT_EQ(doubt.group, ColumnGroup::kAcceleration);
    EXPECT_EQ(doubt.axes, axes);
  }
  ImportStreams positions = known_motion();
  for (Pose& pose : positions.pose.T_world_body) std::swap(pose.translation_m.y(), pose.translation_m.z());
  const ImportDoubt doubt = only_doubt(positions);
  EXPECT_EQ(doubt.group, ColumnGroup::kPosition);
  EXPECT_EQ(doubt.axes, "x,z,y");
}

TEST(CheckStreams, ALeverArmIsNoWrongAxis) {
  // The body's origin is 0.4 m from the sensor: positions and accelerometer differ, and no axes are wrong.
  ImportStreams far = known_motion();
  for (Pose& pose : far.pose.T_world_body) pose.translation_m += pose.rotation * Eigen::Vector3d(0.3, -0.2, 0.2);
  EXPECT_THAT(check_streams(far).doubts, IsEmpty());
}

TEST(CheckStreams, NamesAnotherOrderOfTheQuaternionItsInverseAndMirrorImages) {
  const ImportStreams right = known_motion();
  const auto changed = [&](auto change) {
    ImportStreams out = right;
    for (Pose& pose : out.pose.T_world_body) pose.rotation = change(pose.rotation);
    return out;
  };
  using Q = Eigen::Quaterniond;
  // Cells x y z w read as w x y z, and w x y z read as x y z w.
  EXPECT_EQ(options(only_doubt(changed([](const Q& q) { return Q(q.x(), q.y(), q.z(), q.w()); }))),
            "--quaternion xyzw");
  EXPECT_EQ(options(only_doubt(changed([](const Q& q) { return Q(q.z(), q.w(), q.x(), q.y()); }))),
            "--quaternion wxyz");
  EXPECT_EQ(options(only_doubt(changed([](const Q& q) { return q.conjugate(); }))), "--invert-rotation");
}

TEST(CheckStreams, DoesNotJudgeWhatDoesNotMove) {
  ImportStreams still = known_motion();
  for (auto& omega : still.rate.value) omega.setZero();
  for (auto& pose : still.pose.T_world_body) pose.rotation.setIdentity();
  for (auto& f : still.specific_force.value) f = {0.0, 0.0, 9.81};
  const StreamChecks checks = check_streams(still);
  EXPECT_THAT(checks.doubts, IsEmpty());
  EXPECT_EQ(checks.rate_ratio, 0.0);
  EXPECT_THAT(checks.notes, testing::Contains(HasSubstr("too little rotation")));
}

TEST(BodyFrame, MirrorsAsTheProductOfMatrices) {
  PoseStream pose = known_motion(1.5).pose;
  const PoseStream before = pose;
  mirror_poses(pose, "y");
  const Eigen::Matrix3d S = Eigen::Vector3d(1, 1, -1).asDiagonal();
  for (std::size_t i = 0; i < pose.size(); ++i) {
    const Eigen::Matrix3d expected = S * before.T_world_body[i].rotation.toRotationMatrix() * S;
    EXPECT_LT((pose.T_world_body[i].rotation.toRotationMatrix() - expected).norm(), 1e-12);
    EXPECT_LT((pose.T_world_body[i].translation_m - S * before.T_world_body[i].translation_m).norm(), 1e-15);
  }
}

TEST(BodyFrame, FindsUpByTheSpecificForce) {
  ImportStreams streams = known_motion();
  EXPECT_EQ(estimate_up(streams)->name, "z");
  // A world with y up: its coordinates are (x, z, −y).
  const Eigen::Quaterniond turn = exp_rotation({-std::numbers::pi / 2.0, 0.0, 0.0});
  for (Pose& pose : streams.pose.T_world_body) pose = Pose{turn, Eigen::Vector3d::Zero()} * pose;
  const auto up = estimate_up(streams);
  EXPECT_EQ(up->name, "y");
  EXPECT_LT(up->angle_rad, 0.02);
  turn_world(streams.pose, axis_vector("y", "up"));
  EXPECT_LT((streams.pose.T_world_body[700].translation_m - known_motion().pose.T_world_body[700].translation_m).norm(),
            1e-12);
  EXPECT_THROW(axis_vector("up", "up"), Error);
  EXPECT_THROW(sensor_axes("x,x,z"), Error);
}

TEST(EulerRotation, IsTheProductOfItsTurns) {
  const Eigen::Vector3d angles(0.3, -0.7, 1.9);
  const Eigen::Matrix3d X = Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitX()).toRotationMatrix();
  const Eigen::Matrix3d Y = Eigen::AngleAxisd(-0.7, Eigen::Vector3d::UnitY()).toRotationMatrix();
  const Eigen::Matrix3d Z = Eigen::AngleAxisd(1.9, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  EXPECT_LT((euler_rotation(angles, "zyx", EulerAxes::kIntrinsic).toRotationMatrix() - Z * Y * X).norm(), 1e-12);
  EXPECT_LT((euler_rotation(angles, "xyz", EulerAxes::kExtrinsic).toRotationMatrix() - Z * Y * X).norm(), 1e-12);
  EXPECT_THROW(euler_rotation(angles, "zxz", EulerAxes::kIntrinsic), Error);
}

}  // namespace
}  // namespace asperity
