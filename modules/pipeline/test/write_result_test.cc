#include "asperity/pipeline/write_result.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <limits>

#include "asperity/base/csv.h"
#include "asperity/base/output.h"
#include "asperity/pipeline/process_recording.h"
#include "asperity/testkit/temp_dir.h"

namespace asperity {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TipMotion make_motion() {
  TipMotion motion;
  motion.t_ns = {5, 1'000'000'007};
  motion.p_world_tip_m = {{0.1, -0.25, 3.0}, {1.0, 2.0, 1e-7}};
  motion.q_world_marker = {Eigen::Quaterniond(1.0, 0.0, 0.0, 0.0), Eigen::Quaterniond(0.5, -0.5, 0.5, 0.5)};
  motion.v_world_tip_mps = {{0.0, 0.0, 0.0}, {0.02, 0.0, -1.0}};
  return motion;
}

TEST(WriteResult, TrajectoryColumns) {
  TipMotion motion = make_motion();
  EXPECT_EQ(format_trajectory_csv(motion),
            "t_ns,px_m,py_m,pz_m,qw,qx,qy,qz,vx_mps,vy_mps,vz_mps,sigma_m,sigma_x_m,sigma_y_m,sigma_z_m\n"
            "5,0.1,-0.25,3,1,0,0,0,0,0,0,nan,nan,nan,nan\n"
            "1000000007,1,2,0.0000001,0.5,-0.5,0.5,0.5,0.02,0,-1,nan,nan,nan,nan\n");
  // Variances 9, 4 and 35: their mean is 16, its root 4; of each axis its own.
  motion.cov_world_tip_m2.assign(2, Eigen::Matrix3d(Eigen::Vector3d(9.0, 4.0, 35.0).asDiagonal()));
  EXPECT_THAT(format_trajectory_csv(motion), ::testing::EndsWith(",-1,4,3,2,5.9160797831\n"));
}

TEST(WriteResult, ProfileColumnsReadBackExactly) {
  Profile profile;
  profile.s_m = {0.0, 2.5e-05};
  profile.height_m = {1.0 / 3.0 * 1e-4, kNan};
  profile.sigma_m = {1e-6, kNan};
  profile.texture_m = {-0.0, kNan};
  profile.force_N = {0.75, kNan};
  profile.speed_mps = {0.025, 0.026};
  const std::string text = format_profile_csv(profile);
  EXPECT_THAT(text, ::testing::StartsWith("s_m,height_m,sigma_m,texture_m,force_N,speed_mps,texture_sigma_m\n0,"));
  EXPECT_THAT(text, ::testing::EndsWith("\n2.5e-05,nan,nan,nan,nan,0.026,nan\n"));
  CsvReader reader(text, "profile.csv");
  ASSERT_TRUE(reader.next());
  EXPECT_EQ(reader.number(1), profile.height_m[0]);
}

TEST(WriteResult, ASpectrumHasItsInterval) {
  SurfaceSpectrum spectrum;
  spectrum.frequency_cycles_per_mm = {0.0, 0.5};
  spectrum.density_m2_mm = {0.0, 2e-12};
  spectrum.low_m2_mm = {0.0, kNan};
  spectrum.high_m2_mm = {1e-12, 4e-12};
  spectrum.noise_m2_mm = {1e-12, 0.5e-12};
  EXPECT_EQ(
      format_spectrum_csv(spectrum),
      "cycles_per_mm,density_m2_mm,low_m2_mm,high_m2_mm,noise_m2_mm\n0,0,0,1e-12,1e-12\n0.5,2e-12,nan,4e-12,5e-13\n");
}

TEST(WriteResult, KnowsItsOwnFolders) {
  namespace fs = std::filesystem;
  const testkit::TempDir dir;
  EXPECT_FALSE(is_result_folder(dir.path()));
  EXPECT_FALSE(is_result_folder(dir / "absent"));
  fs::create_directories(dir / "out" / "one");
  write_file(dir / "out" / "one" / "result.json", R"({"format":"asperity-result","version":1})");
  EXPECT_TRUE(is_result_folder(dir / "out" / "one"));
  EXPECT_TRUE(is_result_folder(dir / "out"));
  write_file(dir / "out" / "notes.txt", "mine");
  EXPECT_FALSE(is_result_folder(dir / "out"));
  EXPECT_EQ(is_result_folder(dir / "out").added.string(), "notes.txt");
  fs::rename(dir / "out" / "notes.txt", dir / "out" / "one" / "notes.txt");
  EXPECT_EQ(is_result_folder(dir / "out").added.string(), "one/notes.txt");
  EXPECT_EQ(is_result_folder(dir / "out" / "one").added.string(), "notes.txt");
  fs::create_directories(dir / "other");
  for (const char* text : {"", "[", "[]", R"({"format":3})", R"({"format":"something"})"}) {
    write_file(dir / "other" / "result.json", text);
    EXPECT_FALSE(is_result_folder(dir / "other")) << text;
  }
}

TEST(ProcessRecording, RefusesAnEmptyRecording) {
  for (const Method method : {ProcessMethods::method<FusedMethod>(), ProcessMethods::method<ThesisMethod>()}) {
    ProcessConfig config;
    config.method = method;
    EXPECT_THROW(process_recording({}, config), Error);
  }
}

TEST(ProcessRecording, StopsWhenAsked) {
  Observer observer;
  observer.cancelled = [] { return true; };
  EXPECT_THROW(process_recording({}, {}, observer), Cancelled);
}

}  // namespace
}  // namespace asperity
