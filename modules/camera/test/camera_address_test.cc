#include <gmock/gmock.h>

#include "asperity/base/error.h"
#include "asperity/camera/open_camera.h"
#include "asperity/testkit/temp_dir.h"

namespace asperity {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(CameraAddress, EveryKindAndOption) {
  const CameraAddress v4l2 = parse_camera_address(
      "v4l2:/dev/video0?size=640x480&rate=119.9&format=grey&exposure=2ms&gain=20&white_balance=4600&focus=0");
  EXPECT_EQ(v4l2.kind, CameraKind::kV4l2);
  EXPECT_EQ(v4l2.path, "/dev/video0");
  EXPECT_EQ(v4l2.v4l2.width, 640);
  EXPECT_EQ(v4l2.v4l2.height, 480);
  EXPECT_EQ(v4l2.v4l2.rate_Hz, 119.9);
  EXPECT_EQ(v4l2.v4l2.format, V4l2Format::kGrey);
  EXPECT_EQ(v4l2.v4l2.exposure_s, 0.002);
  EXPECT_EQ(v4l2.v4l2.gain, 20);
  EXPECT_EQ(v4l2.v4l2.white_balance_K, 4600);
  EXPECT_EQ(v4l2.v4l2.focus, 0);
  EXPECT_EQ(parse_camera_address("v4l2:/dev/video1").v4l2.exposure_s, std::nullopt);

  const CameraAddress images = parse_camera_address("images:what?/frames?rate=45");
  EXPECT_EQ(images.kind, CameraKind::kImages);
  EXPECT_EQ(images.path, "what?/frames");
  EXPECT_EQ(images.images.rate_Hz, 45.0);
  EXPECT_EQ(parse_camera_address("y4m:-").path, "-");
  EXPECT_EQ(parse_camera_address("video:C:a.mp4").path, "C:a.mp4");
}

TEST(CameraAddress, SaysWhatIsWrong) {
  const auto refuses = [](const std::string& text, const std::string& part) {
    EXPECT_THAT([&] { parse_camera_address(text); }, ThrowsMessage<Error>(HasSubstr(part))) << text;
  };
  refuses("", "none of v4l2:");
  refuses("/dev/video0", "none of v4l2:");
  refuses("http://camera/stream", "none of v4l2:");
  refuses("v4l2:", "names no device");
  refuses("y4m:?rate=3", "names no file");
  refuses("y4m:a?rate=3", "option 'rate': unknown; there are none");
  refuses("images:a?size=3x3", "option 'size': unknown; there is rate");
  refuses("images:a?rate=0", "'0' is not a rate");
  refuses("images:a?rate=nan", "'nan' is not a rate");
  refuses("images:a?rate", "has no value");
  refuses("images:a?", "has no value");
  refuses("images:a?rate=3&rate=3", "given twice");
  refuses("v4l2:a?size=640", "'640' is not a size");
  refuses("v4l2:a?size=640x9000", "is not a size");
  refuses("v4l2:a?exposure=2", "not a number with a unit");
  refuses("v4l2:a?exposure=0s", "not within");
  refuses("v4l2:a?gain=-1", "not a whole number");
  refuses("v4l2:a?format=rgb", "none of any, grey");
  refuses("v4l2:a?colour=1", "there are size, rate");
  refuses("\x1b[31m:a", "\\x1b");
}

// Each kind reaches its own opener: the message is that one's.
TEST(OpenCamera, OpensEveryKind) {
  const testkit::TempDir dir;
  const auto refuses = [](const std::string& address, const std::string& part) {
    EXPECT_THAT([&] { open_camera(parse_camera_address(address)); }, ThrowsMessage<Error>(HasSubstr(part))) << address;
  };
  refuses("v4l2:/proc/self/status", "v4l2:/proc/self/status: is not a video device");
  refuses("y4m:" + (dir / "none").string(), "none: cannot be opened");
  refuses("images:" + dir.path().string(), "holds no image");
  refuses("video:" + (dir / "none").string(), "none: is not a file");
}

}  // namespace
}  // namespace asperity
