#include <gmock/gmock.h>

#include <fmt/format.h>
#include <cmath>
#include <string>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/base/output.h"
#include "asperity/import/format_import.h"
#include "asperity/import/import_mapped.h"
#include "asperity/import/read_delimited.h"
#include "asperity/import/read_stroke.h"
#include "asperity/testkit/temp_dir.h"
#include "known_motion.h"

namespace asperity {
namespace {

using testing::HasSubstr;
using testing_import::known_motion;

double true_force_N(double t_s) { return 1.0 + 0.3 * std::sin(2.0 * t_s); }

// The known motion as one table at the sensor's rate: time, specific force, rates, positions in mm, a quaternion, and
// the force in newtons under the name that is given ("": none).
std::string one_table(const std::string& positions, const std::string& force) {
  std::string out =
      "time_us,ax,ay,az,gx,gy,gz," + positions + ",qw,qx,qy,qz" + (force.empty() ? "" : "," + force) + "\n";
  constexpr int kRows = 1500;
  constexpr double kRate_Hz = 250.0;
  for (int i = 0; i < kRows; ++i) {
    const double t = i / kRate_Hz;
    const Eigen::Vector3d f = testing_import::force_at(t), w = testing_import::rate_at(t),
                          p = 1e3 * testing_import::position_at(t);
    const Eigen::Quaterniond q = testing_import::rotation_at(t);
    out += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{}", 4000 * i, f.x(), f.y(), f.z(), w.x(), w.y(), w.z(),
                       p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z());
    out += force.empty() ? "\n" : fmt::format(",{}\n", true_force_N(t));
  }
  return out;
}

class GuessedColumns : public testing::Test {
 protected:
  ImportTables tables_of(const std::string& text, const MappingConfig& config = {}) {
    write_file(dir_ / "all.csv", text);
    return read_import_tables({dir_ / "all.csv", {}, {}, {}, {}}, config);
  }
  testkit::TempDir dir_;
};

// The file has positions of 0.9 m and no force: what is read as newtons would be 900 of them.
TEST_F(GuessedColumns, PositionsAreNotAForce) {
  for (const char* positions : {"x_mm,y_mm,z_mm", "X,Y,Z", "X [mm],Y [mm],Z [mm]", "x mm,y mm,z mm", "px,py,pz"}) {
    ImportTables tables = tables_of(one_table(positions, ""));
    EXPECT_FALSE(tables.force) << positions;
    ASSERT_TRUE(tables.pose);
    EXPECT_EQ(find_meaning(tables.pose->map, "pz")->column, 9u) << positions;
    EXPECT_TRUE(unused_columns(tables.all()).empty()) << positions;
  }
}

TEST_F(GuessedColumns, AForceHasManyNames) {
  for (const char* name : {"F", "force", "force_N", "F_N", "Fz_N", "fz", "Fz [N]", "Load", "load cell", "load_N",
                           "normal_force", "normal force [N]", "Newton", "FN", "contactForce", "Kraft"}) {
    ImportTables tables = tables_of(one_table("x_mm,y_mm,z_mm", name));
    ASSERT_TRUE(tables.force) << name;
    ASSERT_NE(find_meaning(tables.force->map, "f"), nullptr) << name;
    EXPECT_EQ(find_meaning(tables.force->map, "f")->column, 14u) << name;
    EXPECT_EQ(find_meaning(tables.force->map, "f")->unit, "N") << name;
  }
  EXPECT_EQ(find_meaning(tables_of(one_table("x_mm,y_mm,z_mm", "normal force [mN]")).force->map, "f")->unit, "mN");
  EXPECT_EQ(find_meaning(tables_of(one_table("x_mm,y_mm,z_mm", "f_mN")).force->map, "f")->unit, "mN");
  ImportTables tables = tables_of(one_table("x_mm,y_mm,z_mm", "force_N"));
  const ImportedMotion motion = read_imported_motion(tables, {});
  ASSERT_EQ(motion.streams.force.size(), 1500u);
  EXPECT_NEAR(motion.streams.force.value[700], true_force_N(2.8), 1e-12);  // all digits are in the file
}

// Another force, and what only looks like one, are not taken: they are named.
TEST_F(GuessedColumns, WhatNobodyUsesIsNamed) {
  for (const char* name : {"grip", "grip force", "friction_force", "CPU load [%]", "height_mm"}) {
    ImportTables tables = tables_of(one_table("x_mm,y_mm,z_mm", name));
    EXPECT_FALSE(tables.force) << name;
    const auto unused = unused_columns(tables.all());
    ASSERT_EQ(unused.size(), 1u) << name;
    EXPECT_EQ(unused[0].columns, std::vector<std::size_t>{14}) << name;
    EXPECT_THAT(import_summary_text(tables), HasSubstr("not used    ")) << name;
    EXPECT_THAT(import_table_text(tables), HasSubstr("all.csv: #15 '")) << name;
    const ImportedMotion motion = read_imported_motion(tables, {});
    EXPECT_THAT(import_json(tables, motion).dump_repaired(2), HasSubstr("\"number\": 15")) << name;
  }
}

// As force sensors of six axes name them.
TEST_F(GuessedColumns, TorquesAreNotPositions) {
  const ImportTables tables = tables_of(
      "t,ax,ay,az,Tx,Ty,Tz,Fx,Fy,Fz,x,y,z,qx,qy,qz,qw\n0,0,0,9.8,1,2,3,4,5,6,0.1,0.2,0.3,0,0,0,1\n"
      "0.01,0,0,9.8,1,2,3,4,5,6,0.1,0.2,0.3,0,0,0,1\n");
  EXPECT_EQ(find_meaning(tables.pose->map, "px")->column, 10u);
  EXPECT_EQ(find_meaning(tables.force->map, "fx")->column, 7u);
  ASSERT_EQ(unused_columns(tables.all()).size(), 1u);
  EXPECT_EQ(unused_columns(tables.all())[0].columns, (std::vector<std::size_t>{4, 5, 6}));
  // Translations alone are positions.
  const ImportTables other =
      tables_of("t,ax,ay,az,tx,ty,tz,qx,qy,qz,qw\n0,0,0,9.8,1,2,3,0,0,0,1\n0.01,0,0,9.8,1,2,3,0,0,0,1\n");
  EXPECT_EQ(find_meaning(other.pose->map, "px")->column, 4u);
}

TEST_F(GuessedColumns, AStatedColumnIsNothingElse) {
  MappingConfig config;
  config.columns = "a=#8-#10[1/1000 g]";  // wrong, but stated: no position is left, and none is invented
  const ImportTables tables = tables_of(one_table("X,Y,Z", ""), config);
  EXPECT_EQ(find_meaning(tables.pose->map, "px"), nullptr);
  EXPECT_FALSE(tables.force);
}

TEST_F(GuessedColumns, AForceInTheSensorsFileIsUsed) {
  std::string pose = "t_s,px_m,py_m,pz_m,qw,qx,qy,qz\n", imu = "time [s],ax,ay,az,gx,gy,gz,force\n";
  const ImportStreams motion = known_motion(4.0);
  for (std::size_t i = 0; i < motion.pose.size(); ++i) {
    const Pose& T = motion.pose.T_world_body[i];
    pose += fmt::format("{},{},{},{},{},{},{},{}\n", 1e-9 * static_cast<double>(motion.pose.t_ns[i]),
                        T.translation_m.x(), T.translation_m.y(), T.translation_m.z(), T.rotation.w(), T.rotation.x(),
                        T.rotation.y(), T.rotation.z());
  }
  for (std::size_t i = 0; i < motion.rate.size(); ++i) {
    const double t = 1e-9 * static_cast<double>(motion.rate.t_ns[i]);
    const Eigen::Vector3d f = motion.specific_force.value[i], w = motion.rate.value[i];
    imu += fmt::format("{},{},{},{},{},{},{},{}\n", t, f.x(), f.y(), f.z(), w.x(), w.y(), w.z(), true_force_N(t));
  }
  write_file(dir_ / "pose.csv", pose);
  write_file(dir_ / "imu.csv", imu);
  const ImportFiles files{dir_ / "pose.csv", dir_ / "imu.csv", {}, {}, {}};
  EXPECT_FALSE(has_fixed_columns(files));
  ImportTables tables = read_import_tables(files, {});
  ASSERT_TRUE(tables.force);
  const ImportedMotion read = read_imported_motion(tables, {});
  const Recording recording = make_imported_recording(read, tables, {}, {});
  ASSERT_EQ(recording.probe.size(), 1000u);
  EXPECT_TRUE(recording.info.has_force_sensor);
  // Half a count of 16 N in 15 bits.
  EXPECT_NEAR(recording.calibration.force.force_N(recording.probe.force_counts[500]), true_force_N(2.0),
              0.5 * 16.0 / 32768.0 + 1e-9);
}

// A force in the poses' file is read again by the mapping that was saved.
TEST_F(GuessedColumns, AForceInThePosesFileIsUsed) {
  std::string pose = "t_s,px_m,py_m,pz_m,qw,qx,qy,qz,load_N\n", imu = "t_s,ax,ay,az,gx,gy,gz\n";
  const ImportStreams motion = known_motion(4.0);
  for (std::size_t i = 0; i < motion.pose.size(); ++i) {
    const Pose& T = motion.pose.T_world_body[i];
    const double t = 1e-9 * static_cast<double>(motion.pose.t_ns[i]);
    pose +=
        fmt::format("{},{},{},{},{},{},{},{},{}\n", t, T.translation_m.x(), T.translation_m.y(), T.translation_m.z(),
                    T.rotation.w(), T.rotation.x(), T.rotation.y(), T.rotation.z(), true_force_N(t));
  }
  for (std::size_t i = 0; i < motion.rate.size(); ++i) {
    const Eigen::Vector3d f = motion.specific_force.value[i], w = motion.rate.value[i];
    imu += fmt::format("{},{},{},{},{},{},{}\n", 1e-9 * static_cast<double>(motion.rate.t_ns[i]), f.x(), f.y(), f.z(),
                       w.x(), w.y(), w.z());
  }
  write_file(dir_ / "pose.csv", pose);
  write_file(dir_ / "imu.csv", imu);
  const ImportFiles files{dir_ / "pose.csv", dir_ / "imu.csv", {}, {}, {}};
  ImportTables tables = read_import_tables(files, {});
  ASSERT_TRUE(tables.force);
  const MappingConfig saved = stated_mapping(tables, {}, read_imported_motion(tables, {}));
  ImportTables again = read_import_tables(files, saved);
  ASSERT_TRUE(again.force);
  const ImportedMotion read = read_imported_motion(again, saved);
  ASSERT_EQ(read.streams.force.size(), 400u);
  EXPECT_NEAR(read.streams.force.value[200], true_force_N(2.0), 1e-12);
}

TEST_F(GuessedColumns, AForceFileWithoutAForceIsToldItsColumns) {
  write_file(dir_ / "all.csv", one_table("x_mm,y_mm,z_mm", ""));
  write_file(dir_ / "f.csv", "t_us;grip\n0;1\n1000;2\n");
  try {
    read_import_tables({dir_ / "all.csv", dir_ / "all.csv", {}, dir_ / "f.csv", {}}, {});
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("f.csv: no column is a force: name it, as f=NAME[N]"));
    EXPECT_THAT(error.what(), HasSubstr("there are #1 't_us', #2 'grip'"));
  }
}

// 2 kHz over 2 s: a circle of 20 mm at 1 turn a second, so the speed is 2π·20 mm/s = 125.66 mm/s.
TEST_F(GuessedColumns, AStrokeHasPositionsInAPlane) {
  std::string text = "t [s],ax_g,ay_g,az_g,x_mm,y_mm,F_N\n";
  constexpr double kTurn = 2.0 * std::numbers::pi;
  for (int i = 0; i < 4000; ++i) {
    const double t = i / 2000.0;
    text += fmt::format("{},{},{},{},{},{},{}\n", t, 0.1 * std::sin(900.0 * t), 0.1 * std::cos(700.0 * t),
                        1.0 + 0.2 * std::sin(1100.0 * t), 20.0 * std::cos(kTurn * t), 20.0 * std::sin(kTurn * t),
                        true_force_N(t));
  }
  write_file(dir_ / "s.csv", text);
  const StrokeReading reading = read_stroke({{}, dir_ / "s.csv", {}}, {}, {});
  ASSERT_TRUE(reading.stroke.speed_is_measured);
  ASSERT_TRUE(reading.stroke.force_is_measured);
  EXPECT_TRUE(reading.stroke.z_m.empty());
  // A chord over ±40 ms is shorter than its arc by (2π·0.04)²/6 = 1.05 %.
  EXPECT_NEAR(reading.stroke.speed_mps[2000], 0.12566 * (1.0 - 0.0105), 1e-4);
  EXPECT_NEAR(reading.stroke.force_N[2000], true_force_N(1.0), 1e-9);
  // X, Y, Z that are stated as the acceleration are no force and no positions.
  std::string three = text;
  three.replace(0, three.find('\n'), "t [s],X,Y,Z,a,b,c");
  write_file(dir_ / "xyz.csv", three);
  MappingConfig stated;
  stated.columns = "a=#2-#4[g]";
  const StrokeReading only = read_stroke({{dir_ / "xyz.csv"}, {}, {}}, stated, {});
  EXPECT_TRUE(only.stroke.force_N.empty());
  EXPECT_TRUE(only.stroke.speed_mps.empty());
}

}  // namespace
}  // namespace asperity
