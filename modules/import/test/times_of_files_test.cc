#include <gmock/gmock.h>

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/base/output.h"
#include "asperity/import/import_mapped.h"
#include "asperity/import/stated_setting.h"
#include "asperity/testkit/temp_dir.h"
#include "known_motion.h"

namespace asperity {
namespace {

using testing::HasSubstr;
using testing_import::known_motion;

double force_N(double t_s) { return 1.0 + 0.3 * std::sin(2.0 * t_s); }

// The known motion in two files whose times are written by `written`, from seconds.
class TimesOfFiles : public testing::Test {
 protected:
  using Written = std::string (*)(double t_s);
  static std::string seconds(double t_s) { return fmt::format("{:.9f}", t_s); }

  void write(Written written, const char* time = "time", double length_s = 6.0) {
    const ImportStreams motion = known_motion(length_s, 100.0, 500.0);
    std::vector<std::string> pose, imu;
    for (std::size_t i = 0; i < motion.pose.size(); ++i) {
      const Pose& T = motion.pose.T_world_body[i];
      pose.push_back(pose_line(written(1e-9 * static_cast<double>(motion.pose.t_ns[i])), T));
    }
    for (std::size_t i = 0; i < motion.rate.size(); ++i) {
      const Eigen::Vector3d &f = motion.specific_force.value[i], &w = motion.rate.value[i];
      imu.push_back(fmt::format("{},{},{},{},{},{},{}\n", written(1e-9 * static_cast<double>(motion.rate.t_ns[i])),
                                f.x(), f.y(), f.z(), w.x(), w.y(), w.z()));
    }
    write_lines("pose.csv", std::string(time) + ",px,py,pz,qw,qx,qy,qz\n", pose);
    write_lines("imu.csv", std::string(time) + ",ax,ay,az,gx,gy,gz\n", imu);
  }

  static std::string pose_line(const std::string& time, const Pose& T) {
    return fmt::format("{},{},{},{},{},{},{},{}\n", time, T.translation_m.x(), T.translation_m.y(), T.translation_m.z(),
                       T.rotation.w(), T.rotation.x(), T.rotation.y(), T.rotation.z());
  }
  void write_lines(const char* name, std::string text, const std::vector<std::string>& lines) {
    for (const std::string& line : lines) text += line;
    write_file(dir_ / name, text);
  }
  void write_force(double rate_Hz, double factor, double from_s = 0.0, double to_s = 6.0) {
    std::string text = "time,force\n";
    for (int i = 0; i < static_cast<int>((to_s - from_s) * rate_Hz); ++i) {
      const double t = from_s + i / rate_Hz;
      text += fmt::format("{},{}\n", t * factor, force_N(t));
    }
    write_file(dir_ / "force.csv", text);
  }
  ImportedMotion read(bool with_force = false) {
    tables_ = read_import_tables(
        {dir_ / "pose.csv", dir_ / "imu.csv", {}, with_force ? dir_ / "force.csv" : std::filesystem::path(), {}}, {});
    return read_imported_motion(tables_, {});
  }
  static std::string all_of(const Problems& problems) {
    std::string out;
    for (const Problem& problem : problems) out += problem.kind + ": " + problem.message + "\n";
    return out;
  }
  template <class Call>
  static std::string error_of(const Call& call) {
    try {
      call();
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  }

  testkit::TempDir dir_;
  ImportTables tables_;
};

// The oracle is the sine that was written, at the time of the motion: a wrong unit stretches it a thousandfold.
TEST_F(TimesOfFiles, AForcesUnitIsThatWhichFitsTheOthers) {
  write(seconds);
  for (const auto& [rate_Hz, factor, unit] :
       {std::tuple(1000.0, 1e3, "ms"), std::tuple(5000.0, 1e3, "ms"), std::tuple(5000.0, 1e6, "us"),
        std::tuple(2.0, 1.0, "s"), std::tuple(5000.0, 1.0, "s"), std::tuple(50.0, 1e6, "us")}) {
    write_force(rate_Hz, factor);
    const ImportedMotion motion = read(true);
    EXPECT_EQ(find_meaning(tables_.force->map, "t")->unit, unit) << rate_Hz;
    const auto& force = motion.streams.force;
    ASSERT_EQ(force.size(), static_cast<std::size_t>(6.0 * rate_Hz));
    const std::size_t middle = force.size() / 2;
    EXPECT_NEAR(force_N(1e-9 * static_cast<double>(force.t_ns[middle])), force.value[middle], 1e-8) << rate_Hz;
    const bool is_guess_right = find_meaning(tables_.force->map, "t")->unit_why == "by its values";
    EXPECT_EQ(all_of(motion.streams.problems).find("time_unit: ") == std::string::npos, is_guess_right) << rate_Hz;
  }
}

TEST_F(TimesOfFiles, AForceAtOtherTimesIsRefusedAndAPartIsNoted) {
  write(seconds);
  write_force(500.0, 1.0, 100.0, 103.0);
  EXPECT_THAT(error_of([&] { read(true); }), HasSubstr("force.csv: the force is at 100 s to 102.998 s"));
  EXPECT_THAT(error_of([&] { read(true); }), HasSubstr("do not overlap; state the unit of its time"));
  write_force(500.0, 1.0, 2.0, 4.0);
  const ImportedMotion motion = read(true);
  ASSERT_FALSE(motion.checks.notes.empty());
  // From 2 s to 3.998 s of 0 s to 5.99 s, the last pose's time.
  EXPECT_THAT(motion.checks.notes[0], HasSubstr("force.csv covers 2.00 s of the 5.99 s that poses"));
}

TEST_F(TimesOfFiles, OneColumnHasOneUnitForAllStreams) {
  write(seconds);
  // Rows in any order: their steps are those of no clock.
  std::string text = "time,ax,ay,az,gx,gy,gz,force\n";
  std::vector<int> rows(3000);
  std::iota(rows.begin(), rows.end(), 0);
  std::shuffle(rows.begin(), rows.end(), std::mt19937(7));
  for (const int i : rows) {
    const double t = i / 500.0;
    const Eigen::Vector3d f = testing_import::force_at(t), w = testing_import::rate_at(t);
    text += fmt::format("{},{},{},{},{},{},{},{}\n", t, f.x(), f.y(), f.z(), w.x(), w.y(), w.z(), force_N(t));
  }
  write_file(dir_ / "imu.csv", text);
  const ImportedMotion motion = read();
  ASSERT_EQ(motion.streams.force.size(), 3000u);
  EXPECT_EQ(motion.streams.force.t_ns, motion.streams.specific_force.t_ns);
  EXPECT_EQ(motion.streams.force.t_ns.back(), 5'998'000'000);
}

std::string wrapping_us(double t_s) {
  const auto us = static_cast<std::uint64_t>(std::llround(1e6 * t_s)) + (std::uint64_t{1} << 32) - 3'000'000;
  return std::to_string(static_cast<std::uint32_t>(us));
}
std::string wrapping_ms(double t_s) {
  const auto ms = static_cast<std::uint64_t>(std::llround(1e3 * t_s)) + (std::uint64_t{1} << 32) - 3'000;
  return std::to_string(static_cast<std::uint32_t>(ms));
}
std::string past_midnight(double t_s) {
  const auto ms = (std::llround(1e3 * t_s) + 86'397'000) % 86'400'000;
  return fmt::format("{:02}:{:02}:{:02}.{:03}", ms / 3'600'000, ms / 60'000 % 60, ms / 1000 % 60, ms % 1000);
}

// The clock passes its end 3 s after the first row: the motion is whole all the same.
TEST_F(TimesOfFiles, AClockThatBeginsAgainIsContinued) {
  for (const auto& [written, range] :
       {std::pair<Written, const char*>(wrapping_us, "2^32 µs"), {wrapping_ms, "2^32 ms"}, {past_midnight, "24 h"}}) {
    write(written);
    const ImportedMotion motion = read();
    const auto& t_ns = motion.streams.specific_force.t_ns;
    ASSERT_EQ(t_ns.size(), 3000u) << range;
    EXPECT_EQ(t_ns.back() - t_ns.front(), 5'998'000'000) << range;
    // Row 1500, the first past the end, is at 3 s.
    EXPECT_LT((motion.streams.specific_force.value[1500] - testing_import::force_at(3.0)).norm(), 1e-9) << range;
    EXPECT_EQ(t_ns[1500] - t_ns.front(), 3'000'000'000) << range;
    const std::string problems = all_of(motion.streams.problems);
    EXPECT_THAT(problems,
                HasSubstr(fmt::format("imu.csv: the clock begins again in line 1502: from there on {}", range)));
    EXPECT_THAT(problems, HasSubstr("pose.csv: the clock begins again in line 302"));
    EXPECT_EQ(problems.find("time_backwards"), std::string::npos) << problems;
    EXPECT_TRUE(motion.checks.doubts.empty());
  }
}

TEST_F(TimesOfFiles, OtherJumpsBackOverHoursAreRefused) {
  write([](double t_s) { return seconds(t_s < 3.0 ? 7200.0 + t_s : t_s); }, "time [s]");
  EXPECT_THAT(error_of([&] { read(); }), HasSubstr("pose.csv:302: a time before that of the row above"));
  EXPECT_THAT(error_of([&] { read(); }), HasSubstr("a gap of 1.998 h"));  // 7200 s less 5.99 s
}

TEST_F(TimesOfFiles, TimesTooCoarseForTheirRateAreRefusedWithTheRate) {
  write([](double t_s) { return fmt::format("{:.2f}", std::floor(100.0 * t_s + 1e-6) / 100.0); }, "time [s]");
  // Four of five rows, less the 400 of the second of rest, which are the same rows.
  try {
    read();
    FAIL();
  } catch (const UnstatedSetting& error) {
    EXPECT_THAT(error.what(),
                HasSubstr("imu.csv: 2000 of 3000 rows of the inertial sensor have the time of an earlier"));
    EXPECT_EQ(error.example().path, "mapping.imu.rate_Hz");
    EXPECT_EQ(error.example().value.substr(0, 3), "500");  // 500 Hz within 0.2 %, as the line through 6 s gives it
  }
  // Rows that were written twice are the same rows.
  write(seconds);
  std::vector<std::string> twice;
  for (const auto& pose : known_motion(6.0).pose.T_world_body) {
    const double t = 0.01 * static_cast<double>(twice.size() / 2);
    twice.insert(twice.end(), 2, pose_line(seconds(t), pose));
  }
  write_lines("pose.csv", "time,px,py,pz,qw,qx,qy,qz\n", twice);
  const ImportedMotion motion = read();
  EXPECT_EQ(motion.streams.pose.size(), 600u);
  EXPECT_THAT(all_of(motion.streams.problems), HasSubstr("pose.csv: 600 rows with the time of an earlier one"));
}

// Thirty rows while the body moves; their poses are zeros, or the last that was seen.
TEST_F(TimesOfFiles, LostPosesAreLeftOut) {
  const auto motion = known_motion(6.0).pose;
  for (const bool zeros : {true, false}) {
    write(seconds);
    std::vector<std::string> lines;
    for (std::size_t i = 0; i < motion.size(); ++i) {
      const bool is_lost = i > 300 && i <= 330;
      const Pose shown = !is_lost ? motion.T_world_body[i] : zeros ? Pose{} : motion.T_world_body[300];
      lines.push_back(pose_line(seconds(0.01 * static_cast<double>(i)), shown));
    }
    write_lines("pose.csv", "time,px,py,pz,qw,qx,qy,qz\n", lines);
    const ImportedMotion out = read();
    ASSERT_EQ(out.streams.pose.size(), 570u) << zeros;
    EXPECT_EQ(out.streams.pose.t_ns[300], 3'000'000'000);
    EXPECT_EQ(out.streams.pose.t_ns[301], 3'310'000'000);
    EXPECT_THAT(all_of(out.streams.problems),
                HasSubstr(zeros ? "lost_poses: " + (dir_ / "pose.csv").string() + ": 30 rows have position 0"
                                : "lost_poses: " + (dir_ / "pose.csv").string() + ": 30 rows repeat the pose"));
    EXPECT_EQ(all_of(out.streams.problems).find("without all values"), std::string::npos);
    EXPECT_TRUE(out.checks.doubts.empty());
    for (const std::string& note : out.checks.notes) EXPECT_EQ(note.find("clocks:"), std::string::npos) << note;
  }
  // The first second is one of rest: its 100 equal poses stay, with a gyroscope's offset too.
  write(seconds);
  std::string imu = "time,ax,ay,az,gx,gy,gz\n";
  for (int i = 0; i < 3000; ++i) {
    const double t = i / 500.0;
    const Eigen::Vector3d f = testing_import::force_at(t), w = testing_import::rate_at(t);
    imu += fmt::format("{},{},{},{},{},{},{}\n", t, f.x(), f.y(), f.z(), w.x() + 0.05, w.y(), w.z());
  }
  write_file(dir_ / "imu.csv", imu);
  EXPECT_EQ(read().streams.pose.size(), 600u);
}

}  // namespace
}  // namespace asperity
