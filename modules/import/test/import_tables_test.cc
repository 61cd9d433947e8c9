#include <gmock/gmock.h>

#include <fmt/format.h>
#include "asperity/base/error.h"
#include "asperity/base/output.h"
#include "asperity/import/format_import.h"
#include "asperity/import/import_mapped.h"
#include "asperity/import/read_delimited.h"
#include "asperity/recording/read_recording.h"
#include "asperity/recording/write_recording.h"
#include "asperity/testkit/temp_dir.h"
#include "known_motion.h"

namespace asperity {
namespace {

using testing::HasSubstr;
using testing_import::known_motion;

ImportTable mapped(const std::string& text, FileRole role, const MappingConfig& config = {},
                   const std::string& name = "x.csv") {
  return map_table(read_delimited(text, name), role, config);
}

std::string columns_of(const ImportTable& table) {
  std::string out;
  for (const MappedColumn& column : table.map) {
    out += fmt::format("{}{}={}#{}{}", out.empty() ? "" : " ", column.meaning, column.negative ? "-" : "",
                       column.column + 1, column.unit == "1" ? "" : column.unit);
  }
  return out;
}

TEST(ParseColumns, TakesNamesNumbersRangesUnitsAndSigns) {
  MappingConfig config;
  config.columns = "t=#1[ms], px=-'X, left'[mm], py=Y[mm], pz=Pos Z, q=#5-#8";
  const ImportTable table =
      mapped("clock,\"X, left\",Y,Pos Z (cm),a,b,c,d\n0,1,2,3,0,0,0,1\n10,1,2,3,0,0,0,1\n", FileRole::kPose, config);
  EXPECT_EQ(columns_of(table), "t=#1ms px=-#2mm py=#3mm pz=#4cm qx=#5 qy=#6 qz=#7 qw=#8");
  config.quaternion = "wxyz";
  config.columns = "t=clock[s],p=#2-#4[inch],q=#5-#8";
  EXPECT_THAT(columns_of(mapped("clock,b,c,d,e,f,g,h\n0,1,2,3,1,0,0,0\n", FileRole::kPose, config)),
              HasSubstr("px=#2inch py=#3inch pz=#4inch qw=#5"));
  for (const auto& [columns, message] :
       {std::pair("px", "a meaning, ="), std::pair("zz=X", "'zz' is not a meaning"),
        std::pair("px=", "column is missing"), std::pair("px=X[furlong]", "'furlong' is not a known unit: m, mm"),
        std::pair("q=#1-#3", "4 columns"), std::pair("px=A,px=B", "stated twice"),
        std::pair("px=W", "no such column; there are #1 'clock'"), std::pair("px=#9", "the table has 3 columns"),
        std::pair("px=x", "this can be #2 'X', #3 'X'")}) {
    try {
      config.columns = columns;
      mapped("clock,X,X\n0,1,2\n", FileRole::kPose, config);
      ADD_FAILURE() << columns;
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), HasSubstr(message));
    }
  }
}

TEST(Presets, AreFoundByContent) {
  const std::string motive =
      "Format Version,1.23,Rotation Type,Quaternion,Length Units,Centimeters\n\n,,Rigid Body,Rigid Body,Rigid "
      "Body,Rigid "
      "Body,Rigid Body,Rigid Body,Rigid "
      "Body\n,,pen,pen,pen,pen,pen,pen,pen\n,,A,A,A,A,A,A,A\n,,Rotation,Rotation,Rotation,"
      "Rotation,Position,Position,Position\nFrame,Time "
      "(Seconds),X,Y,Z,W,X,Y,Z\n0,0.0,0,0,0,1,1,2,3\n1,0.1,0,0,0,1,1,2,3\n";
  const ImportTable pen = mapped(motive, FileRole::kPose);
  EXPECT_EQ(pen.preset.name, "motive");
  EXPECT_EQ(pen.preset.up, "y");
  EXPECT_EQ(columns_of(pen), "t=#2s px=#7cm py=#8cm pz=#9cm qw=#6 qx=#3 qy=#4 qz=#5");

  const ImportTable vicon = mapped(
      "Objects\n200\n,,p : pen,,,,,\nFrame,Sub "
      "Frame,RX,RY,RZ,TX,TY,TZ\n,,rad,rad,rad,mm,mm,mm\n1,0,0,0,0,1,2,3\n2,0,0,0,0,1,"
      "2,3\n",
      FileRole::kPose);
  EXPECT_EQ(vicon.preset.name, "vicon-tracker");
  EXPECT_EQ(columns_of(vicon), "vx=#3rad vy=#4rad vz=#5rad px=#6mm py=#7mm pz=#8mm");
  EXPECT_EQ(vicon.rate_Hz, 200.0);

  const ImportTable qualisys = mapped(
      "NO_OF_FRAMES\t2\nFREQUENCY\t100\nDATA_INCLUDED\t6D\nBODY_NAMES\tpen\npen "
      "X\tY\tZ\tRoll\tPitch\tYaw\tResidual\tRot[0]\tRot[1]\tRot[2]\tRot[3]\tRot[4]\tRot[5]\tRot[6]\tRot[7]\tRot[8]\n"
      "1\t2\t3\t0\t0\t90\t0.1\t0\t1\t0\t-1\t0\t0\t0\t0\t1\n1\t2\t3\t0\t0\t90\t0.1\t0\t1\t0\t-1\t0\t0\t0\t0\t1\n",
      FileRole::kPose);
  EXPECT_EQ(qualisys.preset.name, "qualisys");
  EXPECT_EQ(qualisys.rate_Hz, 100.0);
  Problems problems;
  const PoseStream turned = read_poses(qualisys, {}, problems);
  EXPECT_EQ(turned.t_ns[1], 10'000'000);
  // A yaw of 90° brings the body's x to the world's y.
  EXPECT_LT((turned.T_world_body[0].rotation * Eigen::Vector3d::UnitX() - Eigen::Vector3d::UnitY()).norm(), 1e-9);
  EXPECT_LT((turned.T_world_body[0].translation_m - Eigen::Vector3d(1e-3, 2e-3, 3e-3)).norm(), 1e-15);

  const ImportTable tum = mapped("1.5 1 2 3 0 0 0 1\n2.5 1 2 3 0 0.6 0 0.8\n", FileRole::kPose, {}, "x.txt");
  EXPECT_EQ(columns_of(tum), "t=#1s px=#2m py=#3m pz=#4m qx=#5 qy=#6 qz=#7 qw=#8");

  std::string imu = "12,500000000,imu", pose = "12,500000000,map,1,2,3,0,0,0,1\n";
  for (int i = 0; i < 37; ++i) imu += "," + std::to_string(i);
  const ImportTable ros = mapped(imu + "\n" + imu + "\n", FileRole::kImu);
  EXPECT_EQ(columns_of(ros), "t=#1s t2=#2ns gx=#17rad/s gy=#18rad/s gz=#19rad/s ax=#29m/s2 ay=#30m/s2 az=#31m/s2");
  EXPECT_EQ(read_vectors(ros, 'a', problems).t_ns[0], 12'500'000'000);
  EXPECT_EQ(mapped(pose + pose, FileRole::kPose).preset.name, "ros2");

  // As rostopic 1.15.15 of Debian 12 printed it from a bag; the bag got the message 3 ms after its stamp.
  const std::string wrench =
      "%time,field.header.seq,field.header.stamp,field.header.frame_id,field.wrench.force.x,field.wrench.force.y,"
      "field.wrench.force.z,field.wrench.torque.x,field.wrench.torque.y,field.wrench.torque.z\n"
      "1700000000003000000,0,1700000000000000000,,0.0,0.0,1.0,0.0,0.0,0.0\n"
      "1700000000007000000,1,1700000000004000000,,0.0,0.0,1.5,0.0,0.0,0.0\n";
  const ImportTable ros1 = mapped(wrench, FileRole::kForce);
  EXPECT_EQ(ros1.preset.name, "ros1");
  EXPECT_EQ(columns_of(ros1), "t=#3ns fx=#5N fy=#6N fz=#7N");
  EXPECT_EQ(read_vectors(ros1, 'f', problems).t_ns[1], 1'700'000'000'004'000'000);

  const std::string logger =
      "time,seconds_elapsed,z,y,x\n1727600000000000000,0.0,-9.7,0.1,0.2\n1727600000010000000,0.01,"
      "-9.7,0.1,0.2\n";
  EXPECT_EQ(columns_of(mapped(logger, FileRole::kImu, {}, "TotalAcceleration.csv")),
            "t=#1ns ax=#5m/s2 ay=#4m/s2 az=#3m/s2");
  EXPECT_EQ(columns_of(mapped(logger, FileRole::kGyro, {}, "Gyroscope.csv")),
            "t=#1ns gx=#5rad/s gy=#4rad/s gz=#3rad/s");
  EXPECT_EQ(columns_of(mapped("\"Time (s)\",\"Acceleration x (m/s^2)\",\"Acceleration y (m/s^2)\",\"Acceleration z "
                              "(m/s^2)\",\"Absolute acceleration (m/s^2)\"\n0,0,0,9.8,9.8\n0.01,0,0,9.8,9.8\n",
                              FileRole::kImu)),
            "t=#1s ax=#2m/s2 ay=#3m/s2 az=#4m/s2");
  EXPECT_THROW(mapped(logger, FileRole::kImu,
                      [] {
                        MappingConfig config;
                        config.imu.preset = "motive";
                        return config;
                      }()),
               Error);
}

// The motion as files of three programs: poses in mm, y up, xyzw; g, deg/s and ms; grams of force at 1 kHz.
class MappedFiles : public testing::Test {
 protected:
  MappedFiles() {
    const ImportStreams motion = known_motion(6.0);
    std::string pose = "ms;X;Y;Z;QX;QY;QZ;QW\n",
                imu =
                    "Timestamp [us],AccX [g],AccY [g],AccZ [g],GyrX [dps],GyrY [dps],GyrZ "
                    "[dps]\n",
                force;
    const Eigen::Quaterniond turn = exp_rotation({-std::numbers::pi / 2.0, 0.0, 0.0});
    for (std::size_t i = 0; i < motion.pose.size(); ++i) {
      const Pose T = Pose{turn, Eigen::Vector3d::Zero()} * motion.pose.T_world_body[i];
      const Eigen::Vector3d p = 1e3 * T.translation_m;
      pose += fmt::format("{};{};{};{};{};{};{};{}\n", 1e-6 * static_cast<double>(motion.pose.t_ns[i]), p.x(), p.y(),
                          p.z(), T.rotation.x(), T.rotation.y(), T.rotation.z(), T.rotation.w());
    }
    for (std::size_t i = 0; i < motion.rate.size(); ++i) {
      const Eigen::Vector3d f = motion.specific_force.value[i] / 9.80665,
                            w = motion.rate.value[i] * 180.0 / std::numbers::pi;
      imu +=
          fmt::format("{},{},{},{},{},{},{}\n", motion.rate.t_ns[i] / 1000, f.x(), f.y(), f.z(), w.x(), w.y(), w.z());
    }
    for (int i = 0; i < 6000; ++i) force += fmt::format("{}\n", 100.0 + 50.0 * std::sin(0.01 * i));
    std::replace(pose.begin(), pose.end(), '.', ',');
    write_file(dir_.path() / "pose.csv", pose);
    write_file(dir_.path() / "imu.csv", imu);
    write_file(dir_.path() / "force.txt", force);
    files_ = {dir_.path() / "pose.csv", dir_.path() / "imu.csv", {}, dir_.path() / "force.txt", {}};
    config_.pose.columns = "t=ms[ms]";
    config_.force.columns = "f=#1[gf]";
    config_.force.rate_Hz = 1000.0;
    config_.tip_m = {0.0, 0.0, -0.12};
  }

  Recording import(const MappingConfig& config) {
    ImportTables tables = read_import_tables(files_, config);
    const ImportedMotion motion = read_imported_motion(tables, config);
    for (const auto& doubt : motion.checks.doubts) ADD_FAILURE() << doubt_text(doubt, tables);
    return make_imported_recording(motion, tables, config, {});
  }

  testkit::TempDir dir_;
  ImportFiles files_;
  MappingConfig config_;
};

TEST_F(MappedFiles, BecomeOneRecordingInItsUnitsAndAxes) {
  const Recording recording = import(config_);
  ASSERT_EQ(recording.tracker.size(), 600u);
  for (const std::size_t i : {std::size_t{0}, std::size_t{311}, std::size_t{599}}) {
    const double t = 0.01 * static_cast<double>(i);
    EXPECT_EQ(recording.tracker.t_ns[i], static_cast<std::int64_t>(i) * 10'000'000);
    // The files hold all digits of a double.
    EXPECT_LT((recording.tracker.T_world_marker[i].translation_m - testing_import::position_at(t)).norm(), 1e-12);
    EXPECT_LT(recording.tracker.T_world_marker[i].rotation.angularDistance(testing_import::rotation_at(t)), 1e-7);
  }
  // The force is faster than the sensor: the rows are its own, between the sensor's first and last.
  EXPECT_EQ(recording.probe.size(), 5997u);
  const Calibration& calibration = recording.calibration;
  for (const std::size_t i : {std::size_t{0}, std::size_t{2500}, std::size_t{4444}}) {
    const double t = 1e-3 * static_cast<double>(i);
    const double force_N = 9.80665e-3 * (100.0 + 50.0 * std::sin(0.01 * static_cast<double>(i)));
    EXPECT_NEAR(calibration.force.force_N(recording.probe.force_counts[i]), force_N, 16.0 / 32768.0);
    // Half a count, and straight lines over 4 ms of an acceleration whose second derivative is below 3e3 m/s⁴.
    EXPECT_LT(
        (calibration.accelerometer.specific_force_mps2(recording.probe.accel_counts[i]) - testing_import::force_at(t))
            .cwiseAbs()
            .maxCoeff(),
        0.01);
  }
  EXPECT_EQ(calibration.tip_in_marker_m, Eigen::Vector3d(0.0, 0.0, -0.12));
  EXPECT_TRUE(recording.info.has_force_sensor);
  EXPECT_FALSE(recording.truth.has_value());

  write_recording(dir_.path(), recording);
  const Recording back = read_recording(dir_.path());
  EXPECT_TRUE(back.problems.empty());
  const Json* origin = back.info.extra.find("import_origin");
  ASSERT_NE(origin, nullptr);
  EXPECT_EQ((*origin->find("files"))[std::size_t{0}].find("file")->text(), "pose.csv");
  EXPECT_EQ(origin->find("up")->text(), "y");
  EXPECT_TRUE(back.info.imported.has_value());
}

TEST_F(MappedFiles, ReadTheSameByTheMappingThatWasSaved) {
  ImportTables tables = read_import_tables(files_, config_);
  const ImportedMotion motion = read_imported_motion(tables, config_);
  const MappingConfig saved = stated_mapping(tables, config_, motion);
  EXPECT_THAT(saved.imu.columns, HasSubstr("ax='AccX'[g]"));
  EXPECT_EQ(saved.up, "y");
  const Recording first = import(config_), second = import(saved);
  EXPECT_EQ(first.probe.t_ns, second.probe.t_ns);
  EXPECT_EQ(first.probe.accel_counts, second.probe.accel_counts);
  EXPECT_EQ(first.tracker.t_ns, second.tracker.t_ns);
  EXPECT_TRUE(std::equal(first.tracker.T_world_marker.begin(), first.tracker.T_world_marker.end(),
                         second.tracker.T_world_marker.begin(), [](const Pose& a, const Pose& b) {
                           return a.translation_m == b.translation_m && a.rotation.coeffs() == b.rotation.coeffs();
                         }));
  EXPECT_THAT(import_table_text(tables), HasSubstr("#2 AccX"));
}

// y points up in these files, and a world read as its negative is upside down.
TEST_F(MappedFiles, AStatedUpIsUsedWhereACheckFails) {
  config_.invert_rotation = true;  // wrong
  for (const char* up : {"y", "-x", ""}) {
    config_.up = up;
    ImportTables tables = read_import_tables(files_, config_);
    const ImportedMotion motion = read_imported_motion(tables, config_);
    ASSERT_FALSE(motion.checks.doubts.empty());
    EXPECT_EQ(motion.up_is_assumed, config_.up.empty());
    if (config_.up.empty()) {
      EXPECT_THAT(import_checks_text(motion), HasSubstr("points up (not stated, assumed"));
      EXPECT_EQ(stated_mapping(tables, config_, motion).up, "");
      continue;
    }
    EXPECT_EQ(motion.up, up);
    EXPECT_THAT(import_checks_text(motion), HasSubstr(std::string(up) + " points up (stated"));
    const Recording recording = make_imported_recording(motion, tables, config_, {});
    // Heights are the file's coordinates along the stated axis: the known motion's, in whose files y is up.
    const Eigen::Vector3d p = testing_import::position_at(3.11);
    EXPECT_NEAR(recording.tracker.T_world_marker[311].translation_m.z(), config_.up == "y" ? p.z() : -p.x(), 1e-12);
  }
}

// The tracker's base stands on a slope of 12°: heights are along the true vertical, which the sensor shows.
TEST_F(MappedFiles, ATiltedWorldIsLevelled) {
  constexpr double kTilt_rad = 12.0 * std::numbers::pi / 180.0;
  const Eigen::Quaterniond tilt = exp_rotation({kTilt_rad, 0.0, 0.0});
  std::string pose = "ms;X;Y;Z;QX;QY;QZ;QW\n";
  const ImportStreams motion = known_motion(6.0);
  for (std::size_t i = 0; i < motion.pose.size(); ++i) {
    const Pose T = Pose{tilt, Eigen::Vector3d::Zero()} * motion.pose.T_world_body[i];
    const Eigen::Vector3d p = 1e3 * T.translation_m;
    pose += fmt::format("{};{};{};{};{};{};{};{}\n", 1e-6 * static_cast<double>(motion.pose.t_ns[i]), p.x(), p.y(),
                        p.z(), T.rotation.x(), T.rotation.y(), T.rotation.z(), T.rotation.w());
  }
  write_file(dir_.path() / "pose.csv", pose);
  const Recording recording = import(config_);
  // The mean acceleration of six seconds moves the vertical by less than 0.5°: 8 mm at a metre's distance.
  for (const std::size_t i : {std::size_t{50}, std::size_t{311}}) {
    const double t = 0.01 * static_cast<double>(i);
    EXPECT_NEAR(recording.tracker.T_world_marker[i].translation_m.z(), testing_import::position_at(t).z(), 8e-3);
  }
  config_.up = "z";
  ImportTables tables = read_import_tables(files_, config_);
  EXPECT_THAT(import_checks_text(read_imported_motion(tables, config_)), HasSubstr("° from z; if the world is tilted"));
}

TEST_F(MappedFiles, TheTrackersNoiseIsTheirOwnOrTheStatedOne) {
  ImportTables tables = read_import_tables(files_, config_);
  ImportedMotion motion = read_imported_motion(tables, config_);
  const auto from = [&](const ImportConfig& import) {
    const Recording out = make_imported_recording(motion, tables, config_, import);
    const Json* origin = out.calibration.extra.find("tracker_sigma_from");
    return origin == nullptr ? std::string()
                             : origin->find("position")->text() + " " + origin->find("rotation")->text();
  };
  motion.noise = {Eigen::Vector3d::Constant(1e-9), Eigen::Vector3d::Constant(1e-9)};  // a computed motion's
  EXPECT_EQ(from({}), "assumed assumed");
  motion.noise = {{1e-4, 1e-9, 1e-4}, Eigen::Vector3d::Constant(2e-3)};
  EXPECT_EQ(from({}), "estimated, assumed estimated");
  motion.noise = {{1e-4, 2e-4, 3e-4}, {1e-3, 2e-3, 3e-3}};
  EXPECT_EQ(from({}), "estimated estimated");
  ImportConfig stated;
  stated.tracker_sigma_rad = 4e-3;
  EXPECT_EQ(from(stated), "estimated stated");
  const Recording out = make_imported_recording(motion, tables, config_, stated);
  EXPECT_EQ(out.calibration.tracker.sigma_position_m, Eigen::Vector3d(1e-4, 2e-4, 3e-4));
  EXPECT_EQ(out.calibration.tracker.sigma_rotation_rad, Eigen::Vector3d::Constant(4e-3));
}

TEST_F(MappedFiles, AForceAmongTheSensorsColumnsIsSentToItsOption) {
  config_.imu.columns = "f=AccX[N]";
  try {
    read_import_tables(files_, config_);
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("f is not a column of the inertial sensor: state it as --force"));
    EXPECT_THAT(error.what(), HasSubstr("--force-columns \"f=AccX[N]\""));
  }
}

TEST_F(MappedFiles, RefuseAUnitThatIsWrong) {
  config_.pose.columns = "t=ms[ms], px=X[m], py=Y[m], pz=Z[m]";
  ImportTables tables = read_import_tables(files_, config_);
  const ImportedMotion motion = read_imported_motion(tables, config_);
  ASSERT_EQ(motion.checks.doubts.size(), 1u);
  const std::string text = doubt_text(motion.checks.doubts[0], tables);
  EXPECT_THAT(text, HasSubstr("pose.csv: columns 'X', 'Y', 'Z' read in m: "));
  EXPECT_THAT(text, HasSubstr("state px=X[mm], py=Y[mm], pz=Z[mm]"));
  // The same unit by a guess is exchanged.
  config_.pose.columns = "t=ms[ms]";
  EXPECT_EQ(find_meaning(read_import_tables(files_, config_).pose->map, "px")->unit, "mm");
}

}  // namespace
}  // namespace asperity
