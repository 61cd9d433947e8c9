#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <numbers>

#include <fmt/format.h>
#include "asperity/base/error.h"
#include "asperity/base/output.h"
#include "asperity/import/import_mapped.h"
#include "asperity/recording/import_imu_pose.h"
#include "asperity/recording/read_recording.h"
#include "asperity/testkit/temp_dir.h"

namespace asperity {
namespace {

// A real hand's first two seconds, and what other programs would have written of it.
class ImportOthers : public testing::Test {
 protected:
  ImportOthers() : imu_(kBroad / "imu.csv"), pose_(kBroad / "mocap.csv"), input_(read_imu_pose(imu_, pose_)) {}

  static Recording imported(const ImportFiles& files, const MappingConfig& config = {}) {
    ImportTables tables = read_import_tables(files, config);
    const ImportedMotion motion = read_imported_motion(tables, config);
    for (const ImportDoubt& doubt : motion.checks.doubts) ADD_FAILURE() << doubt_text(doubt, tables);
    return make_imported_recording(motion, tables, config, {});
  }

  // Times, poses and counts as the plain import has them; `digits_m` is the last digit that was written.
  void expect_same(const Recording& recording, double digits_m, double digits_rad) {
    const Recording plain = import_imu_pose(input_, {});
    ASSERT_EQ(recording.tracker.size(), plain.tracker.size());
    for (std::size_t i = 0; i < plain.tracker.size(); ++i) {
      const Pose &a = recording.tracker.T_world_marker[i], &b = plain.tracker.T_world_marker[i];
      EXPECT_EQ(recording.tracker.t_ns[i] - recording.tracker.t_ns[0], plain.tracker.t_ns[i] - plain.tracker.t_ns[0]);
      ASSERT_LT((a.translation_m - b.translation_m).cwiseAbs().maxCoeff(), digits_m);
      ASSERT_LT(a.rotation.angularDistance(b.rotation), digits_rad);
    }
    ASSERT_EQ(recording.probe.size(), plain.probe.size());
    for (std::size_t i = 0; i < plain.probe.size(); ++i) {
      // A reading between two counts may be rounded to the other one.
      ASSERT_LE((recording.probe.accel_counts[i] - plain.probe.accel_counts[i]).cwiseAbs().maxCoeff(), 1.0);
      ASSERT_LE((recording.probe.gyro_counts[i] - plain.probe.gyro_counts[i]).cwiseAbs().maxCoeff(), 1.0);
    }
  }

  double pose_s(std::size_t i) const { return 1e-9 * static_cast<double>(input_.pose_t_ns[i]); }

  static inline const std::filesystem::path kBroad =
      (std::filesystem::path(ASPERITY_TEST_DATA) / "../../../recording/test/data/broad_trial10").lexically_normal();
  testkit::TempDir dir_;
  std::filesystem::path imu_, pose_;
  ImportInput input_;
};

TEST_F(ImportOthers, ReadsTum) {
  std::string text = "# timestamp tx ty tz qx qy qz qw\n";
  for (std::size_t i = 0; i < input_.pose_t_ns.size(); ++i) {
    const auto& p = input_.T_world_body[i].translation_m;
    const auto& q = input_.T_world_body[i].rotation;
    text += fmt::format("{:.6f} {:.9f} {:.9f} {:.9f} {:.9f} {:.9f} {:.9f} {:.9f}\n", pose_s(i), p.x(), p.y(), p.z(),
                        q.x(), q.y(), q.z(), q.w());
  }
  write_file(dir_ / "tum.txt", text);
  expect_same(imported({dir_ / "tum.txt", imu_, {}, {}, {}}), 1e-9, 1e-7);
}

// Decimal comma, semicolons, byte order mark; mm, degrees, g and ms in one file.
TEST_F(ImportOthers, ReadsAGermanTableOfEverything) {
  std::string text =
      "Datum;22.11.2026\n\nZeit [ms];X [mm];Y [mm];Z [mm];Roll [°];Pitch [°];Yaw [°];AccX [g];AccY [g];AccZ "
      "[g];GyroX [°/s];GyroY [°/s];GyroZ [°/s]\n";
  constexpr double kDegree = std::numbers::pi / 180.0;
  for (std::size_t i = 0; i < input_.pose_t_ns.size(); ++i) {
    const Eigen::Vector3d p = 1e3 * input_.T_world_body[i].translation_m;
    const Eigen::Matrix3d R = input_.T_world_body[i].rotation.toRotationMatrix();
    const Eigen::Vector3d f = input_.specific_force_mps2[i] / 9.80665, w = input_.rate_radps[i] / kDegree;
    text += fmt::format("{:.3f};{:.6f};{:.6f};{:.6f};{:.7f};{:.7f};{:.7f};{:.9f};{:.9f};{:.9f};{:.7f};{:.7f};{:.7f}\n",
                        1e3 * pose_s(i), p.x(), p.y(), p.z(), std::atan2(R(2, 1), R(2, 2)) / kDegree,
                        -std::asin(R(2, 0)) / kDegree, std::atan2(R(1, 0), R(0, 0)) / kDegree, f.x(), f.y(), f.z(),
                        w.x(), w.y(), w.z());
  }
  const auto head = text.find("Zeit");
  std::replace(text.begin() + static_cast<std::ptrdiff_t>(text.find('\n', head)), text.end(), '.', ',');
  write_file(dir_ / "alles.csv", "\xEF\xBB\xBF" + text);
  MappingConfig config;
  config.euler = "zyx";
  expect_same(imported({dir_ / "alles.csv", {}, {}, {}, {}}, config), 1e-9, 1e-8);
}

// The arrays of BROAD's files side by side, as its authors name them: no times, one rate for all.
TEST_F(ImportOthers, ReadsBroadsOwnColumns) {
  std::string text =
      "imu_acc_x,imu_acc_y,imu_acc_z,imu_gyr_x,imu_gyr_y,imu_gyr_z,opt_pos_x,opt_pos_y,opt_pos_z,"
      "opt_quat_w,opt_quat_x,opt_quat_y,opt_quat_z\n";
  for (std::size_t i = 0; i < input_.pose_t_ns.size(); ++i) {
    const Eigen::Vector3d &f = input_.specific_force_mps2[i], &w = input_.rate_radps[i];
    const auto& p = input_.T_world_body[i].translation_m;
    const auto& q = input_.T_world_body[i].rotation;
    text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{}\n", f.x(), f.y(), f.z(), w.x(), w.y(), w.z(), p.x(),
                        p.y(), p.z(), q.w(), q.x(), q.y(), q.z());
  }
  write_file(dir_ / "trial.csv", text);
  MappingConfig config;
  config.columns = "a=#1-#3[m/s2], g=#4-#6[rad/s], p=#7-#9[m], q=#10-#13";
  config.quaternion = "wxyz";
  try {
    read_import_tables({dir_ / "trial.csv", {}, {}, {}, {}}, config);
    ADD_FAILURE() << "the rate is not known";
  } catch (const UnstatedSetting& error) {
    EXPECT_THAT(error.what(), testing::EndsWith("or state the rate of the rows"));
    EXPECT_EQ(as_option(error.example()), "--pose-file-rate 500");
  }
  config.pose.rate_Hz = 2000.0 / 7.0;
  expect_same(imported({dir_ / "trial.csv", {}, {}, {}, {}}, config), 1e-15, 1e-7);
}

TEST_F(ImportOthers, ReadsItsOwnFormToo) { expect_same(imported({pose_, imu_, {}, {}, {}}), 1e-15, 1e-7); }

}  // namespace
}  // namespace asperity
