#include "asperity/camera/open_video.h"

#include <gmock/gmock.h>
#include <cstdlib>
#include <fstream>
#include <opencv2/videoio.hpp>

#include "asperity/testkit/temp_dir.h"
#include "asperity/transport/byte_source.h"

namespace asperity {
namespace {

using std::chrono::milliseconds;
using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(OpenVideo, ImagesAndTimesOfTheContainer) {
  const testkit::TempDir dir;
  const std::string path = (dir / "a.avi").string();
  cv::VideoWriter writer(path, cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 45.0, {64, 48}, false);
  ASSERT_TRUE(writer.isOpened());
  for (int i = 0; i < 6; ++i) writer.write(cv::Mat(48, 64, CV_8UC1, cv::Scalar(40.0 * i)));
  writer.release();

  const auto camera = open_video(path);
  EXPECT_NEAR(camera->nominal_rate_Hz(), 45.0, 1e-6);
  CameraFrame frame;
  for (int i = 0; i < 6; ++i) {
    ASSERT_TRUE(camera->read(frame, milliseconds(0)));
    EXPECT_NEAR(static_cast<double>(frame.t_ns), i * 1e9 / 45.0, 1000.0) << i;  // ns; the container counts images
    EXPECT_EQ(frame.image.width, 64);
    EXPECT_EQ(frame.image.height, 48);
    EXPECT_NEAR(frame.image.at(30, 20), 40 * i, 4);  // gray levels, after JPEG and the way to colours and back
  }
  EXPECT_THROW(camera->read(frame, milliseconds(0)), LinkLost);
}

TEST(OpenVideo, RefusesWhatIsNoVideo) {
  const testkit::TempDir dir;
  const auto refuses = [&](const std::string& content, const std::string& part) {
    std::ofstream(dir / "a.mp4", std::ios::binary) << content;
    EXPECT_THAT([&] { open_video(dir / "a.mp4"); }, ThrowsMessage<Error>(HasSubstr(part)));
  };
  refuses("", "is not a video that can be read");
  refuses("#EXTM3U\n#EXTINF:1,\n/etc/hostname\n", "is not a video that can be read");
  refuses("ffconcat version 1.0\nfile x.mp4\n", "is not a video that can be read");
  EXPECT_THAT([] { open_video("http://localhost/a.mp4"); }, ThrowsMessage<Error>(HasSubstr("is not a file")));
  EXPECT_THAT([&] { open_video(dir.path()); }, ThrowsMessage<Error>(HasSubstr("is not a file")));
}

}  // namespace
}  // namespace asperity
