#include "asperity/recording/read_recording.h"

#include <gmock/gmock.h>
#include <sys/stat.h>
#include <fstream>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/base/output.h"
#include "asperity/recording/parse_recording.h"
#include "asperity/testkit/temp_dir.h"

namespace asperity {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::ThrowsMessage;

const std::filesystem::path kData = ASPERITY_TEST_DATA;
const std::string kProbe = "t_ns,accel_i,accel_j,accel_k,force\n";
const std::string kTracker = "t_ns,px_m,py_m,pz_m,qw,qx,qy,qz\n";

void parse_by_name(const std::string& name, const std::string& text) {
  Problems problems;
  if (name.ends_with("recording.json")) {
    parse_recording_info(text, name);
  } else if (name.ends_with("calibration.json")) {
    parse_calibration(text, name);
  } else if (name.ends_with("probe.csv")) {
    parse_probe_csv(text, name, problems);
  } else if (name.ends_with("tracker.csv")) {
    parse_tracker_csv(text, name, problems);
  } else if (name.ends_with("truth.csv")) {
    parse_truth_csv(text, name, problems);
  } else {
    FAIL() << name;
  }
}

TEST(ReadRecording, SmallestGoodRecording) {
  const Recording recording = read_recording(kData / "good_minimal");
  EXPECT_THAT(recording.problems, IsEmpty());
  EXPECT_EQ(recording.info.world, "camera");
  EXPECT_EQ(recording.probe.accel_counts[0], Eigen::Vector3d(1.0, 2.0, 2048.0));
  EXPECT_TRUE(std::isnan(recording.probe.force_counts[0]));
  EXPECT_FALSE(recording.probe.has_gyro());
  EXPECT_EQ(recording.calibration.tip_radius_m, 0.00032);
  EXPECT_FALSE(recording.truth.has_value());
}

TEST(ReadRecording, EverythingTheFormatAllows) {
  const Recording recording = read_recording(kData / "good_full");
  EXPECT_THAT(recording.problems, IsEmpty());
  EXPECT_EQ(recording.info.segments.at(1).name, "back");
  EXPECT_EQ(recording.info.problems.at("lost_packets"), 2);
  EXPECT_EQ(recording.info.gravity_world_mps2, Eigen::Vector3d(0.0, 0.0, -9.81));
  ASSERT_EQ(recording.probe.size(), 3u);
  EXPECT_EQ(recording.probe.accel_counts[1], Eigen::Vector3d(1.5, -2.0, 2047.0));
  EXPECT_TRUE(recording.probe.gyro_counts[1].array().isNaN().all());
  EXPECT_EQ(recording.probe.force3_counts[2], Eigen::Vector3d(4.0, 5.0, 6.0));
  EXPECT_THAT(recording.tracker.markers, ElementsAre(2, 1));
  EXPECT_EQ(recording.calibration.accelerometer.model, AccelerometerModel::kQuadric);
  EXPECT_EQ(recording.calibration.accelerometer.position_sigma_m, 0.02);
  EXPECT_EQ(recording.calibration.extra.dump_sorted(), R"({"note":"bench 3"})");
  EXPECT_FALSE(recording.calibration.accelerometer.rotation_known);
  EXPECT_EQ(recording.calibration.tracker.latency_s, 0.03);
  EXPECT_EQ(recording.calibration.markers.at(0).id, 7);
  ASSERT_EQ(recording.truth->size(), 2u);
  EXPECT_TRUE(std::isnan(recording.truth->s_m[1]));
}

TEST(ReadRecording, EachBadFileIsRefusedWithItsPlace) {
  std::ifstream table(kData / "bad" / "expected.tsv");
  std::string line;
  int count = 0;
  while (std::getline(table, line)) {
    const auto tab = line.find('\t');
    ASSERT_NE(tab, std::string::npos);
    const std::string name = line.substr(0, tab);
    const std::string text = read_file(kData / "bad" / name, 1 << 20);
    EXPECT_THAT([&] { parse_by_name(name, text); },
                ThrowsMessage<Error>(testing::AllOf(testing::StartsWith(name + ":"), HasSubstr(line.substr(tab + 1)))))
        << name;
    ++count;
  }
  EXPECT_GT(count, 50);
}

TEST(ReadRecording, NamesTheFileThatIsMissing) {
  const testkit::TempDir dir;
  EXPECT_THAT([&] { read_recording(dir / "none"); }, ThrowsMessage<Error>(HasSubstr("not a recording folder")));
  EXPECT_THAT([&] { read_recording(dir.path()); }, ThrowsMessage<Error>(HasSubstr("recording.json is missing")));
  std::filesystem::copy(kData / "good_minimal", dir / "rec");
  std::filesystem::remove(dir / "rec" / "tracker.csv");
  EXPECT_THAT([&] { read_recording(dir / "rec"); }, ThrowsMessage<Error>(HasSubstr("tracker.csv: no such file")));
  std::filesystem::remove(dir / "rec" / "calibration.json");
  EXPECT_THAT([&] { read_recording(dir / "rec"); }, ThrowsMessage<Error>(HasSubstr("calibration.json is missing")));
  EXPECT_TRUE(is_recording_folder(dir / "rec"));
  write_file(dir / "rec" / "recording.json", R"({"format":"asperity-scene"})");
  EXPECT_FALSE(is_recording_folder(dir / "rec"));
  write_file(dir / "rec" / "recording.json", R"({"format":5})");
  EXPECT_FALSE(is_recording_folder(dir / "rec"));
}

TEST(ReadRecording, LongReadIsStopped) {
  std::string text = R"({"format":"asperity-recording","version":1,"extra":{"many":[0)";
  for (int i = 0; i < 10000; ++i) text += ",0";
  text += "]}}";
  EXPECT_EQ(parse_recording_info(text, "r.json").extra.at("many").size(), 10001u);
  Observer observer;
  observer.cancelled = [] { return true; };
  EXPECT_THROW(parse_recording_info(text, "r.json", {}, observer), Cancelled);
  EXPECT_THROW(read_recording(kData / "good_minimal", {}, observer), Cancelled);
}

TEST(ReadRecording, BoundsAreCheckedBeforeReading) {
  const testkit::TempDir dir;
  std::filesystem::copy(kData / "good_minimal", dir / "rec");
  // A sparse file of a terabyte, which no memory would hold.
  std::filesystem::resize_file(dir / "rec" / "probe.csv", std::uintmax_t{1} << 40);
  EXPECT_THAT([&] { read_recording(dir / "rec"); },
              ThrowsMessage<Error>(HasSubstr("more than the limit of 4294967296")));
  std::filesystem::remove(dir / "rec" / "probe.csv");
  ASSERT_EQ(::mkfifo((dir / "rec" / "probe.csv").c_str(), 0600), 0);
  EXPECT_THAT([&] { read_recording(dir / "rec"); }, ThrowsMessage<Error>(HasSubstr("not a regular file")));
}

TEST(ReadRecording, ShuffledRowsAreSorted) {
  Problems problems;
  const auto probe = parse_probe_csv(kProbe + "30,3,0,0,\n10,1,0,0,\n20,2,0,0,7\n20,9,9,9,9\n", "p.csv", problems);
  EXPECT_THAT(probe.t_ns, ElementsAre(10, 20, 30));
  EXPECT_EQ(probe.accel_counts[1].x(), 2.0);
  EXPECT_EQ(probe.force_counts[1], 7.0);
  ASSERT_EQ(problems.size(), 2u);
  EXPECT_EQ(problems[0].kind, "time_backwards");
  EXPECT_EQ(problems[0].count, 1u);
  EXPECT_THAT(problems[0].message, testing::StartsWith("p.csv:3: "));
  EXPECT_EQ(problems[1].kind, "duplicate_time");
  EXPECT_THAT(problems[1].message, testing::StartsWith("p.csv:5: "));
}

TEST(ReadRecording, RowsThatAreNoReadingsAreLeftOut) {
  Problems problems;
  const auto probe = parse_probe_csv(kProbe +
                                         "0,1,1,1,1\n"
                                         "nan,1,1,1,1\n"
                                         ",1,1,1,1\n"
                                         "1,nan,1,1,1\n"
                                         "2,1,,1,1\n"
                                         "3,1,1,inf,1\n"
                                         "4,1,1,1e300,1\n"
                                         "5,1,1,1,-inf\n"
                                         "9223372036854775807,1,1,1,1\n",
                                     "p.csv", problems);
  EXPECT_THAT(probe.t_ns, ElementsAre(0, 5));
  EXPECT_TRUE(std::isnan(probe.force_counts[1]));
  ASSERT_EQ(problems.size(), 4u);
  EXPECT_EQ(problems[0].kind, "missing_time");
  EXPECT_EQ(problems[0].count, 2u);
  EXPECT_EQ(problems[1].kind, "bad_acceleration");
  EXPECT_EQ(problems[1].count, 4u);
  EXPECT_EQ(problems[2].kind, "bad_sample");
  EXPECT_EQ(problems[3].kind, "time_far_off");
}

TEST(ReadRecording, AFlippedBitInATimeCannotStretchTheRecording) {
  Problems problems;
  const auto probe = parse_probe_csv(
      kProbe + "-4000000000000000000,0,0,0,\n0,1,0,0,\n10,2,0,0,\n4611686018427387904,3,0,0,\n20,4,0,0,\n", "p.csv",
      problems);
  EXPECT_THAT(probe.t_ns, ElementsAre(0, 10, 20));
  EXPECT_THAT(problems, testing::Contains(testing::Field(&Problem::kind, "time_far_off")));
}

TEST(ReadRecording, QuaternionsAreMadeUnitOrLeftOut) {
  Problems problems;
  const auto tracker = parse_tracker_csv(kTracker +
                                             "0,0,0,0,1.0000001,0,0,0\n"
                                             "1,0,0,0,0,1.0005,0,0\n"
                                             "2,0,0,0,0,0,0,0\n"
                                             "3,0,0,0,0.9,0,0,0\n"
                                             "4,0,0,0,nan,0,0,0\n"
                                             "5,0,nan,0,1,0,0,0\n"
                                             "6,1e6,0,0,1,0,0,0\n"
                                             "7,0,0,0,0,0,0.6,0.8\n",
                                         "t.csv", problems);
  EXPECT_THAT(tracker.t_ns, ElementsAre(0, 1, 7));
  for (const auto& pose : tracker.T_world_marker) EXPECT_NEAR(pose.rotation.norm(), 1.0, 1e-15);
  ASSERT_EQ(problems.size(), 4u);
  EXPECT_EQ(problems[0].kind, "quaternion_length");
  EXPECT_EQ(problems[1].kind, "bad_quaternion");
  EXPECT_EQ(problems[1].count, 2u);
  EXPECT_EQ(problems[2].kind, "missing_pose");
  EXPECT_EQ(problems[2].count, 2u);
  EXPECT_EQ(problems[3].kind, "position_far_off");
}

TEST(ReadRecording, CutAtAnyByteReadsUpToTheLastWholeLine) {
  const std::string whole = kProbe + "0,1,2,3,4\n250000,-15,26,37,48\n500000,1,2,3,\n";
  const std::size_t first_row_end = kProbe.size() + 10;
  for (std::size_t size = first_row_end; size <= whole.size(); ++size) {
    const std::string text = whole.substr(0, size);
    Problems problems;
    const auto probe = parse_probe_csv(text, "p.csv", problems);
    EXPECT_EQ(probe.size(), static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) - 1);
    const auto truncated = testing::ElementsAre(testing::Field(&Problem::kind, "truncated"));
    if (text.back() == '\n') {
      EXPECT_THAT(problems, IsEmpty());
    } else {
      EXPECT_THAT(problems, truncated);
    }
  }
}

TEST(ReadRecording, ATailOfZeroBytesAfterAPowerCutIsPassedOver) {
  Problems problems;
  const auto probe = parse_probe_csv(kProbe + "0,1,2,3,4\n" + std::string(4096, '\0') + "\xff\xfe", "p.csv", problems);
  EXPECT_EQ(probe.size(), 1u);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].kind, "truncated");
}

}  // namespace
}  // namespace asperity
