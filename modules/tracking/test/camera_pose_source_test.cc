#include "asperity/tracking/camera_pose_source.h"

#include <gmock/gmock.h>

#include <deque>
#include <filesystem>
#include <fstream>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/camera/frame_writer.h"
#include "asperity/image/read_gray_image.h"
#include "asperity/testkit/temp_dir.h"
#include "asperity/transport/byte_source.h"

namespace asperity {
namespace {

using testing::ElementsAre;

GrayImage plain_image(std::uint8_t gray) {
  GrayImage out;
  out.width = 64;
  out.height = 48;
  out.pixels.assign(64 * 48, gray);
  out.pixels[100] = static_cast<std::uint8_t>(255 - gray);
  return out;
}

// Frames that wait in groups: a group is there at once, then one read finds nothing. At the end it is lost.
class FakeCamera : public CameraSource {
 public:
  explicit FakeCamera(std::deque<std::deque<std::int64_t>> groups) : groups_(std::move(groups)) {}

  bool read(CameraFrame& frame, std::chrono::milliseconds) override {
    if (groups_.empty()) throw LinkLost("fake: unplugged");
    if (groups_.front().empty()) {
      groups_.pop_front();
      return false;
    }
    frame.t_ns = groups_.front().front();
    frame.image = plain_image(0);
    groups_.front().pop_front();
    if (groups_.size() == 1 && groups_.front().empty()) groups_.pop_front();
    return true;
  }
  std::string name() const override { return "fake camera"; }
  std::vector<std::string> warnings() const override { return {"focus is not locked"}; }

 private:
  std::deque<std::deque<std::int64_t>> groups_;
};

BodyTracker small_tracker() {
  CameraCalibration camera;
  camera.width = 64;
  camera.height = 48;
  camera.fx = camera.fy = 60.0;
  camera.cx = 31.5;
  camera.cy = 23.5;
  MarkerPlacement tag;
  tag.id = 1;
  tag.family = "tag36h11";
  tag.size_m = 0.04;
  return {camera, {tag}};
}

constexpr std::chrono::milliseconds kNow{0};

TEST(CameraPoseSource, TakesTheNewestFrameAndCountsTheOthers) {
  std::vector<std::int64_t> seen;
  const auto poses = make_camera_pose_source(
      std::make_unique<FakeCamera>(std::deque<std::deque<std::int64_t>>{{1, 2, 3}, {4}, {5, 6}}), small_tracker(),
      {true, 120.0}, [&](const CameraFrame& frame) { seen.push_back(frame.t_ns); });
  EXPECT_EQ(poses->nominal_rate_Hz(), 120.0);
  EXPECT_THAT(poses->warnings(), ElementsAre("focus is not locked"));
  EXPECT_FALSE(poses->read(kNow));
  EXPECT_EQ(poses->statistics().frames, 3u);
  EXPECT_EQ(poses->statistics().skipped_frames, 2u);
  EXPECT_FALSE(poses->read(kNow));
  EXPECT_EQ(poses->statistics().frames, 4u);
  // The camera goes while the rest is passed over: its last frame is still tracked.
  EXPECT_FALSE(poses->read(kNow));
  EXPECT_EQ(poses->statistics().frames, 6u);
  EXPECT_EQ(poses->statistics().skipped_frames, 3u);
  EXPECT_THROW(poses->read(kNow), LinkLost);
  EXPECT_THAT(seen, ElementsAre(1, 2, 3, 4, 5, 6));
}

TEST(CameraPoseSource, OfAFileEveryFrame) {
  const auto poses = make_camera_pose_source(
      std::make_unique<FakeCamera>(std::deque<std::deque<std::int64_t>>{{1, 2, 3}}), small_tracker(), {false, 0.0});
  for (int i = 0; i < 3; ++i) EXPECT_FALSE(poses->read(kNow));
  EXPECT_EQ(poses->statistics().frames, 3u);
  EXPECT_EQ(poses->statistics().skipped_frames, 0u);
  EXPECT_THROW(poses->read(kNow), LinkLost);
}

TEST(FrameWriter, KeepsImagesExactly) {
  const testkit::TempDir dir;
  FrameWriter writer(dir / "frames");
  for (int i = 0; i < 3; ++i) writer.push({1000 + i, plain_image(static_cast<std::uint8_t>(80 * i))});
  writer.finish();
  EXPECT_EQ(writer.counts().written, 3u);
  EXPECT_EQ(writer.counts().dropped, 0u);
  for (int i = 0; i < 3; ++i) {
    const GrayImage image = read_gray_image(dir / "frames" / (std::to_string(1000 + i) + ".png"));
    EXPECT_EQ(image.pixels, plain_image(static_cast<std::uint8_t>(80 * i)).pixels);
  }
}

// What others have put into the folder is neither followed nor replaced.
TEST(FrameWriter, WritesThroughNoLinkOfOthers) {
  const testkit::TempDir dir;
  std::filesystem::create_directories(dir / "frames");
  std::ofstream(dir / "elsewhere") << "theirs";
  std::filesystem::create_symlink(dir / "elsewhere", dir / "frames" / ".png.new");
  FrameWriter writer(dir / "frames");
  writer.push({1, plain_image(1)});
  writer.finish();
  EXPECT_EQ(writer.counts().failure, "");
  EXPECT_EQ(read_file(dir / "elsewhere", 100), "theirs");
  EXPECT_FALSE(std::filesystem::is_symlink(dir / "frames" / "1.png"));
}

TEST(FrameWriter, NamesTheImageThatCannotBeWrittenAndWhy) {
  const testkit::TempDir dir;
  std::filesystem::create_directories(dir / "frames" / "2.png");
  FrameWriter writer(dir / "frames");
  for (int i = 1; i <= 3; ++i) writer.push({i, plain_image(1)});
  writer.finish();
  EXPECT_EQ(writer.counts().written, 1u);
  EXPECT_EQ(writer.counts().dropped, 2u);
  EXPECT_THAT(writer.counts().failure, testing::HasSubstr((dir / "frames" / "2.png").string() + ": cannot be written"));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(dir / "frames"), {}), 2);
}

TEST(FrameWriter, SaysWhatItCouldNotKeep) {
  const testkit::TempDir dir;
  FrameWriter writer(dir / "frames");
  writer.push({1, {}});  // an image of no size
  writer.finish();
  writer.push({2, plain_image(1)});
  EXPECT_EQ(writer.counts().written, 0u);
  EXPECT_EQ(writer.counts().dropped, 2u);
  EXPECT_THAT(writer.counts().failure, testing::HasSubstr("no size"));
}

}  // namespace
}  // namespace asperity
