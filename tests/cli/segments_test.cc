#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "asperity/recording/read_recording.h"
#include "asperity/recording/write_recording.h"
#include "asperity/testkit/temp_dir.h"
#include "run_asperity.h"

namespace asperity::cli {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

template <class T>
void append_column(std::vector<T>& to, const std::vector<T>& more) {
  to.insert(to.end(), more.begin(), more.end());
}

// The same stroke twice, ten seconds apart, as a recorder would list it.
void write_two_strokes(const fs::path& one, const fs::path& two, bool by_recorder) {
  Recording recording = read_recording(one);
  const std::int64_t start_ns = recording.probe.t_ns.front();
  const std::int64_t end_ns = std::max(recording.probe.t_ns.back(), recording.tracker.t_ns.back());
  const std::int64_t later_ns = end_ns - start_ns + 10'000'000'000;
  const auto later = [&](std::vector<std::int64_t> t_ns) {
    for (std::int64_t& t : t_ns) t += later_ns;
    return t_ns;
  };
  recording.truth.reset();
  ProbeStream& probe = recording.probe;
  append_column(probe.t_ns, later(probe.t_ns));
  append_column(probe.accel_counts, std::vector(probe.accel_counts));
  append_column(probe.force_counts, std::vector(probe.force_counts));
  append_column(probe.gyro_counts, std::vector(probe.gyro_counts));
  append_column(probe.force3_counts, std::vector(probe.force3_counts));
  TrackerStream& tracker = recording.tracker;
  append_column(tracker.t_ns, later(tracker.t_ns));
  append_column(tracker.T_world_marker, std::vector(tracker.T_world_marker));
  append_column(tracker.markers, std::vector(tracker.markers));
  append_column(tracker.reprojection_px, std::vector(tracker.reprojection_px));
  recording.info.segments = {{"contact_1", start_ns, end_ns}, {"contact 2/..", start_ns + later_ns, end_ns + later_ns}};
  if (by_recorder) recording.info.recorder.emplace().state = "finished";
  fs::create_directory(two);
  write_recording(two, recording);
}

TEST(Segments, AreProcessedEachForItself) {
  const testkit::TempDir dir;
  ASSERT_EQ(run({"simulate", "--surface", "sine", "--set", "hand.length_m=0.03", "-o", (dir / "one").string()}).code,
            0);
  fs::remove(dir / "one" / "truth.csv");
  ASSERT_EQ(run({"process", (dir / "one").string(), "-o", (dir / "alone").string(), "--quiet"}).code, 0);
  const std::string profile = contents(dir / "alone").front().second;
  for (const bool by_recorder : {false, true}) {
    const fs::path two = dir / (by_recorder ? "recorded" : "two");
    write_two_strokes(dir / "one", two, by_recorder);
    const Outcome outcome = run({"process", two.string(), "-o", (dir / "out").string(), "--json"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const auto json = nlohmann::json::parse(outcome.out);
    EXPECT_EQ(json["format"], "asperity-results");
    EXPECT_EQ(json["results"].size(), 2u);
    // A profile does not depend on when it was recorded.
    for (const char* name : {"contact_1", "contact_2_.."}) {
      EXPECT_TRUE(json["results"].contains(name));
      EXPECT_EQ(contents(dir / "out" / name).front().second, profile) << name;
    }
  }
  // Again into the same folder, one segment by its name: a result of its own.
  const Outcome one = run({"process", (dir / "two").string(), "--segment", "contact_1", "-o", (dir / "out").string()});
  EXPECT_EQ(one.code, 0) << one.err;
  EXPECT_EQ(contents(dir / "out").front().second, profile);
  const Outcome none = run({"process", (dir / "two").string(), "--segment", "x", "-o", (dir / "out").string()});
  EXPECT_EQ(none.code, 1);
  EXPECT_THAT(none.err, HasSubstr("its segments: contact_1"));
  // Beside another recording: OUT/NAME/SEGMENT/.
  ASSERT_EQ(run({"process", (dir / "two").string(), (dir / "one").string(), "-o", (dir / "both").string()}).code, 0);
  EXPECT_TRUE(fs::exists(dir / "both" / "two" / "contact_1" / "profile.csv"));
  EXPECT_TRUE(fs::exists(dir / "both" / "one" / "profile.csv"));
  EXPECT_EQ(run({"process", (dir / "two").string(), "-o", (dir / "both").string(), "--quiet"}).code, 0);
}

}  // namespace
}  // namespace asperity::cli
