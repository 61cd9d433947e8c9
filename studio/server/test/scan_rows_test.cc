#include <gmock/gmock.h>

#include <limits>
#include <thread>

#include "read_block.h"
#include "scan/kept_rows.h"
#include "scan/live_scan_buffer.h"
#include "scan/row_tap.h"
#include "scan/scan_blocks.h"

namespace asperity::studio {
namespace {

using ::testing::ElementsAre;

std::vector<ProbeSample> rows_at(std::initializer_list<std::int64_t> times) {
  std::vector<ProbeSample> out(times.size());
  std::size_t i = 0;
  for (const std::int64_t t_ns : times) out[i++].t_ns = t_ns;
  return out;
}

TEST(RowTap, GivesEachRowOnceAndCountsWhatItDrops) {
  RowTap tap;
  RowTap::TakenRows taken;
  tap.add(rows_at({1, 2, 3}));
  tap.take(taken);
  EXPECT_EQ(taken.first_row, 0U);
  EXPECT_EQ(taken.rows.size(), 3U);
  const std::vector<ProbeSample> many(RowTap::kMostRows - 1);
  tap.add(many);
  tap.add(rows_at({7, 8}));
  tap.take(taken);
  EXPECT_EQ(taken.rows.size(), 2U);
  EXPECT_EQ(taken.rows_dropped, RowTap::kMostRows - 1);
  EXPECT_EQ(taken.first_row, 3U + RowTap::kMostRows - 1);
  tap.take(taken);
  EXPECT_TRUE(taken.rows.empty());
}

TEST(RowTap, KeepsAnImageOnlyWhenItIsWanted) {
  RowTap tap;
  RowTap::TakenRows taken;
  CameraFrame frame;
  frame.t_ns = 1;
  frame.image = {2, 1, {10, 20}};
  tap.add(frame);
  tap.take(taken);
  EXPECT_FALSE(taken.image);
  tap.want_images(true);
  tap.add(frame);
  frame.t_ns = 2;  // the first one was passed over by the tracker
  tap.add(frame);
  TrackedPose pose;
  pose.sample.t_ns = 2;
  tap.add(pose);
  tap.take(taken);
  ASSERT_TRUE(taken.image);
  EXPECT_EQ(taken.image->small.t_ns, 2);
  EXPECT_TRUE(taken.image->pose);
  frame.t_ns = 3;  // too soon after the last
  tap.add(frame);
  tap.take(taken);
  EXPECT_FALSE(taken.image);
}

TEST(RowTap, ShowsAnImageInWhichNothingIsSeen) {
  RowTap tap;
  RowTap::TakenRows taken;
  tap.want_images(true);
  CameraFrame frame;
  frame.image = {2, 1, {10, 20}};
  for (const std::int64_t t_ns : {std::int64_t{1}, 1 + RowTap::kPoseWait_ns}) {
    frame.t_ns = t_ns;
    tap.add(frame);
  }
  tap.take(taken);
  ASSERT_TRUE(taken.image);
  EXPECT_FALSE(taken.image->pose);
}

TEST(SmallImage, IsTheMeanOfSquares) {
  CameraFrame frame;
  frame.image = {4, 2, {0, 10, 100, 100, 20, 30, 100, 104}};
  const SmallImage small = make_small(frame, 2);
  EXPECT_EQ(small.factor, 2);
  EXPECT_THAT(small.image.pixels, ElementsAre(15, 101));
}

TEST(SmallImage, HasTheTagsWhereTheyAre) {
  SmallImage small;
  small.t_ns = 5;
  small.factor = 2;
  small.image = {2, 1, {1, 2}};
  TrackedPose pose;
  pose.sample.t_ns = 5;
  TagDetection tag;
  tag.id = 3;
  tag.corners_px << -0.5, 3.5, 3.5, -0.5, -0.5, -0.5, 1.5, 1.5;  // the edges of the full image
  pose.tags.push_back(tag);
  const ReadBlock block(image_block({small, pose}).take());
  EXPECT_EQ(block.head.at("tags").at(0).at("id"), 3);
  const Json expected = {-0.5, -0.5, 1.5, -0.5, 1.5, 0.5, -0.5, 0.5};  // those of the small one
  EXPECT_EQ(block.head.at("tags").at(0).at("corners_px"), expected);
  EXPECT_TRUE(ReadBlock(image_block({small, std::nullopt}).take()).head.at("tags").empty());
}

TEST(KeptRows, ForgetsWhatIsOldUnlessItIsHeld) {
  constexpr std::int64_t kSecond_ns = 1'000'000'000;
  KeptRows kept;
  kept.add(rows_at({kSecond_ns, 10 * kSecond_ns, 14 * kSecond_ns}));
  EXPECT_FALSE(kept.covers(kSecond_ns));
  EXPECT_TRUE(kept.covers(2 * kSecond_ns));
  kept.hold(true);
  kept.add(rows_at({60 * kSecond_ns}));
  EXPECT_TRUE(kept.covers(2 * kSecond_ns));
  kept.hold(false);
  kept.add(rows_at({61 * kSecond_ns}));
  EXPECT_FALSE(kept.covers(2 * kSecond_ns));
}

TEST(KeptRows, ReplaysBothStreamsInTheOrderOfTheirTimes) {
  KeptRows kept;
  kept.add(rows_at({10, 20, 30, 30, 25, 40}));  // what does not rise is left out
  for (const std::int64_t t_ns : {5, 15, 20, 45}) {
    TrackerSample pose;
    pose.t_ns = t_ns;
    kept.add(pose);
  }
  std::vector<std::int64_t> order;
  const auto replay = [&](std::int64_t start_ns, std::int64_t end_ns) {
    order.clear();
    kept.replay(
        start_ns, end_ns, [&](const ProbeSample& row) { order.push_back(row.t_ns); },
        [&](const TrackerSample& pose) { order.push_back(-pose.t_ns); });
  };
  replay(0, 100);
  EXPECT_THAT(order, ElementsAre(-5, 10, -15, -20, 20, 30, 40, -45));
  replay(15, 30);
  EXPECT_THAT(order, ElementsAre(-15, -20, 20, 30));
}

LiveEstimate grown(std::initializer_list<double> s_m) {
  LiveEstimate out;
  for (const double s : s_m) {
    out.points.push_back({0, s, 2.0 * s, 0.1, 0.2, 0.3, 0.4});
    LiveTip tip;
    tip.p_world_tip_m = {s, 0.0, 0.0};
    tip.contact = true;
    out.tips.push_back(tip);
  }
  return out;
}

TEST(LiveScanBuffer, GrowsByFramesThatFollowEachOther) {
  LiveScanBuffer book;
  EXPECT_FALSE(book.grown());
  book.add(grown({0.0, 1.0}), true);
  const ReadBlock first(book.take_growth().take());
  EXPECT_EQ(first.head.at("first"), 0);
  EXPECT_FALSE(book.grown());
  book.add(grown({2.0}), true);
  const ReadBlock second(book.take_growth().take());
  EXPECT_EQ(second.head.at("first"), 2);
  EXPECT_EQ(second.head.at("sequence"), first.head.at("sequence").get<int>() + 1);
  EXPECT_EQ(second.head.at("generation"), first.head.at("generation"));
  EXPECT_THAT(second.array<double>("s_m"), ElementsAre(2.0));
  EXPECT_THAT(ReadBlock(book.profile().take()).array<float>("height_m"), ElementsAre(0.F, 2.F, 4.F));
  EXPECT_THAT(ReadBlock(book.take_motion().take()).array<float>("tip_m"),
              ElementsAre(0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 2.F, 0.F, 0.F));
  book.restart();
  book.add(grown({7.0}), true);
  const ReadBlock anew(book.take_growth().take());
  EXPECT_EQ(anew.head.at("generation"), second.head.at("generation").get<int>() + 1);
  EXPECT_EQ(anew.head.at("first"), 0);
}

TEST(LiveScanBuffer, ThinsAPathThatIsFullAndKeepsLittleOfTheAir) {
  LiveScanBuffer book;
  LiveEstimate one;
  one.tips.resize(LiveScanBuffer::kMostTips / 10);
  for (int i = 0; i < 11; ++i) book.add(one, true);
  const std::size_t stored = ReadBlock(book.path().take()).array<float>("force_N").size();
  EXPECT_LE(stored, LiveScanBuffer::kMostTips);
  EXPECT_GE(stored, LiveScanBuffer::kMostTips / 2);
  for (int i = 0; i < 40; ++i) book.add(one, false);
  const std::size_t all = ReadBlock(book.path().take()).array<float>("force_N").size();
  EXPECT_GE(all, stored);
  EXPECT_LE(all, stored + LiveScanBuffer::kMostTipsInTheAir);
}

TEST(LiveScanBuffer, HasAPathButNoProfileWhileNothingIsStored) {
  LiveScanBuffer book;
  book.add(grown({0.0, 1.0}), false);
  EXPECT_TRUE(book.moved());
  EXPECT_FALSE(book.grown());
}

}  // namespace
}  // namespace asperity::studio
