#include "asperity/recording/cut_recording.h"

#include <gmock/gmock.h>

#include "asperity/base/error.h"
#include "asperity/recording/validate_recording.h"
#include "random_recording.h"

namespace asperity {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

Recording any_recording(std::uint64_t seed) { return random_recording(seed); }

TEST(CutRecording, KeepsTheRowsOfTheSpan) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Recording whole = any_recording(seed);
    const std::int64_t start_ns = whole.probe.t_ns[whole.probe.size() / 4];
    const std::int64_t end_ns = whole.probe.t_ns[whole.probe.size() / 2];
    const Recording part = cut_recording(whole, start_ns, end_ns);
    std::size_t row = 0;
    for (std::size_t i = 0; i < whole.probe.size(); ++i) {
      if (whole.probe.t_ns[i] < start_ns || whole.probe.t_ns[i] > end_ns) continue;
      ASSERT_LT(row, part.probe.size());
      EXPECT_EQ(part.probe.t_ns[row], whole.probe.t_ns[i]);
      EXPECT_EQ(part.probe.accel_counts[row], whole.probe.accel_counts[i]);
      ++row;
    }
    EXPECT_EQ(row, part.probe.size());
    EXPECT_EQ(part.probe.has_gyro(), whole.probe.has_gyro());
    EXPECT_EQ(part.truth.has_value(), whole.truth.has_value());
    for (const std::int64_t t_ns : part.tracker.t_ns) {
      EXPECT_GE(t_ns, start_ns);
      EXPECT_LE(t_ns, end_ns);
    }
    if (part.tracker.size() > 0) {
      EXPECT_NO_THROW(validate_recording(part));
    }
  }
}

TEST(CutRecording, TheWholeSpanIsTheWholeRecording) {
  Recording whole = any_recording(3);
  whole.info.segments = {{"a", 10, 20}, {"b", 20, 40}};
  const Recording same = cut_recording(whole, INT64_MIN, INT64_MAX);
  EXPECT_EQ(same.probe.t_ns, whole.probe.t_ns);
  EXPECT_EQ(same.tracker.t_ns, whole.tracker.t_ns);
  EXPECT_EQ(same.info.segments.size(), 2u);
  const Recording part = cut_recording(whole, 15, 20);
  ASSERT_EQ(part.info.segments.size(), 1u);
  EXPECT_EQ(part.info.segments[0].start_ns, 15);
  EXPECT_EQ(part.info.segments[0].end_ns, 20);
}

std::vector<std::string> names(const std::vector<Segment>& segments) {
  std::vector<std::string> out;
  for (const auto& segment : segments) out.push_back(segment.name);
  return out;
}

TEST(SeparateSegments, OneStrokeWithRestsIsProcessedAsItIs) {
  Recording recording;
  EXPECT_THAT(separate_segments(recording), IsEmpty());
  recording.info.segments = {
      {"rest", 0, 1'000'000'000}, {"stroke", 1'000'000'000, 5'000'000'000}, {"rest", 5'000'000'000, 6'000'000'000}};
  EXPECT_THAT(separate_segments(recording), IsEmpty());
}

TEST(SeparateSegments, GapsSeparate) {
  Recording recording;
  recording.info.segments = {
      {"rest", 0, 1'000'000'000}, {"left", 1'000'000'000, 5'000'000'000}, {"right", 5'200'000'000, 6'000'000'000}};
  const auto pieces = separate_segments(recording);
  EXPECT_THAT(names(pieces), ElementsAre("left", "right"));
  EXPECT_EQ(pieces[0].start_ns, 0);
  EXPECT_EQ(pieces[0].end_ns, 5'000'000'000);
}

TEST(SeparateSegments, ARecordersSegmentsStandAlone) {
  Recording recording;
  recording.info.recorder.emplace().state = "finished";
  recording.info.segments = {{"contact_1", 0, 1'000'000'000}, {"contact_2", 900'000'000, 2'000'000'000}};
  EXPECT_THAT(names(separate_segments(recording)), ElementsAre("contact_1", "contact_2"));
}

TEST(FindSegment, NamesWhatThereIs) {
  Recording recording;
  recording.info.segments = {{"rest", 0, 1}, {"stroke", 1, 2}, {"rest", 2, 3}};
  EXPECT_EQ(find_segment(recording, "stroke").start_ns, 1);
  EXPECT_THAT([&] { find_segment(recording, "x"); },
              testing::ThrowsMessage<Error>(testing::HasSubstr("its segments: rest, stroke, rest")));
  EXPECT_THAT([&] { find_segment(recording, "rest"); },
              testing::ThrowsMessage<Error>(testing::HasSubstr("more than one")));
}

TEST(SegmentFolders, AreSafeAndDistinct) {
  EXPECT_THAT(segment_folders({{"a b/../c", 0, 1}, {"..", 0, 1}, {"", 0, 1}, {"x", 0, 1}, {"x", 0, 1}, {"x_5", 0, 1}}),
              ElementsAre("a_b_.._c", "segment", "segment_3", "x", "x_5", "x_5_6"));
  EXPECT_EQ(segment_folders({{std::string(1000, 'y'), 0, 1}})[0].size(), 64u);
}

}  // namespace
}  // namespace asperity
