#include "asperity/camera/open_v4l2.h"

#include <gmock/gmock.h>
#include <algorithm>

#include "asperity/base/host_clock.h"
#include "asperity/testkit/encode_jpeg.h"
#include "asperity/transport/byte_source.h"
#include "fake_v4l2.h"

namespace asperity {
namespace {

using std::chrono::milliseconds;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::ThrowsMessage;

std::unique_ptr<CameraSource> open(FakeCamera& camera, const V4l2Config& config = {}) {
  return open_v4l2("/dev/video7", config, std::make_unique<FakeV4l2>(camera));
}

// All that a good webcam has, on automatic.
void add_controls(FakeCamera& camera) {
  camera.controls[V4L2_CID_EXPOSURE_AUTO] = {0, 3, V4L2_EXPOSURE_APERTURE_PRIORITY};
  camera.controls[V4L2_CID_EXPOSURE_ABSOLUTE] = {1, 5000, 78};
  camera.controls[V4L2_CID_EXPOSURE_AUTO_PRIORITY] = {0, 1, 1};
  camera.controls[V4L2_CID_GAIN] = {0, 255, 12};
  camera.controls[V4L2_CID_AUTO_WHITE_BALANCE] = {0, 1, 1};
  camera.controls[V4L2_CID_WHITE_BALANCE_TEMPERATURE] = {2000, 6500, 4100};
  camera.controls[V4L2_CID_FOCUS_AUTO] = {0, 1, 1};
  camera.controls[V4L2_CID_FOCUS_ABSOLUTE] = {0, 250, 35};
}

FakeCamera small(std::uint32_t fourcc) {
  FakeCamera out;
  out.modes = {{fourcc, 4, 2, {{1, 120}, {1, 30}}}};
  add_controls(out);
  return out;
}

FakeCamera::Frame frame_of(std::vector<unsigned char> bytes, std::int64_t t_us) {
  FakeCamera::Frame out;
  out.bytes = std::move(bytes);
  out.stamp = {t_us / 1'000'000, t_us % 1'000'000};
  return out;
}

TEST(OpenV4l2, LocksWhatACameraWouldAdapt) {
  FakeCamera camera = small(V4L2_PIX_FMT_YUYV);
  const auto source = open(camera, {.rate_Hz = 120.0});
  EXPECT_THAT(source->warnings(), IsEmpty());
  EXPECT_EQ(source->nominal_rate_Hz(), 120.0);
  EXPECT_EQ(source->name(), "v4l2:/dev/video7");
  EXPECT_EQ(camera.controls[V4L2_CID_EXPOSURE_AUTO].value, V4L2_EXPOSURE_MANUAL);
  EXPECT_EQ(camera.controls[V4L2_CID_EXPOSURE_AUTO_PRIORITY].value, 0);
  EXPECT_EQ(camera.controls[V4L2_CID_EXPOSURE_ABSOLUTE].value, 78);  // as it had found
  EXPECT_EQ(camera.controls[V4L2_CID_AUTO_WHITE_BALANCE].value, 0);
  EXPECT_EQ(camera.controls[V4L2_CID_FOCUS_AUTO].value, 0);
  EXPECT_EQ(camera.controls[V4L2_CID_FOCUS_ABSOLUTE].value, 35);
}

TEST(OpenV4l2, SetsTheValuesGiven) {
  FakeCamera camera = small(V4L2_PIX_FMT_YUYV);
  const auto source =
      open(camera, {.rate_Hz = 120.0, .exposure_s = 0.002, .gain = 20, .white_balance_K = 4600, .focus = 0});
  EXPECT_THAT(source->warnings(), IsEmpty());
  EXPECT_EQ(camera.controls[V4L2_CID_EXPOSURE_ABSOLUTE].value, 20);  // 100 µs
  EXPECT_EQ(camera.controls[V4L2_CID_GAIN].value, 20);
  EXPECT_EQ(camera.controls[V4L2_CID_WHITE_BALANCE_TEMPERATURE].value, 4600);
  EXPECT_EQ(camera.controls[V4L2_CID_FOCUS_ABSOLUTE].value, 0);
  FakeCamera other = small(V4L2_PIX_FMT_YUYV);
  EXPECT_THAT([&] { open(other, {.gain = 300}); }, ThrowsMessage<Error>(HasSubstr("gain 300 is not within 0 to 255")));
  EXPECT_EQ(other.open_files, 0);
}

TEST(OpenV4l2, WarnsOfWhatCannotBeLocked) {
  FakeCamera no_focus = small(V4L2_PIX_FMT_YUYV);
  no_focus.controls.erase(V4L2_CID_FOCUS_AUTO);
  no_focus.controls.erase(V4L2_CID_FOCUS_ABSOLUTE);
  EXPECT_THAT(open(no_focus)->warnings(), ElementsAre("focus is not locked: the camera has no control for it"));

  FakeCamera stubborn = small(V4L2_PIX_FMT_YUYV);
  stubborn.controls[V4L2_CID_EXPOSURE_AUTO].read_only = true;
  stubborn.controls[V4L2_CID_AUTO_WHITE_BALANCE].forgets = true;
  EXPECT_THAT(open(stubborn)->warnings(),
              ElementsAre(HasSubstr("exposure is not locked: the camera keeps adapting it"),
                          HasSubstr("white balance is not locked: the camera went back to adapting it")));

  FakeCamera grey = small(V4L2_PIX_FMT_GREY);  // without colours white balance changes nothing
  grey.controls.erase(V4L2_CID_AUTO_WHITE_BALANCE);
  grey.controls.erase(V4L2_CID_WHITE_BALANCE_TEMPERATURE);
  EXPECT_THAT(open(grey)->warnings(), IsEmpty());
}

TEST(OpenV4l2, WarnsOfALowerRate) {
  FakeCamera slow = small(V4L2_PIX_FMT_YUYV);
  slow.slowest_denominator = 15;
  EXPECT_THAT(open(slow, {.rate_Hz = 120.0})->warnings(), Contains("the rate is 15 Hz, not 120 Hz"));
  FakeCamera dark = small(V4L2_PIX_FMT_YUYV);
  dark.controls[V4L2_CID_EXPOSURE_ABSOLUTE].value = 200;  // as a camera finds in a dim room: 20 ms
  EXPECT_THAT(open(dark, {.rate_Hz = 120.0})->warnings(),
              Contains("the exposure of 20 ms is longer than a frame at 120 Hz: the rate drops"));
  FakeCamera keeps = small(V4L2_PIX_FMT_YUYV);
  keeps.controls[V4L2_CID_EXPOSURE_AUTO_PRIORITY].read_only = true;
  EXPECT_THAT(open(keeps)->warnings(), Contains(HasSubstr("exposure may lower the rate")));
}

TEST(OpenV4l2, LumaOfEveryFormat) {
  const std::vector<std::uint8_t> luma = {10, 20, 30, 40, 50, 60, 70, 80};
  const auto check = [&](std::uint32_t fourcc, const std::vector<unsigned char>& bytes, std::uint32_t bytes_per_line) {
    FakeCamera camera = small(fourcc);
    camera.bytes_per_line = bytes_per_line;
    camera.frames.push_back(frame_of(bytes, 1'234'567));
    const auto source = open(camera);
    CameraFrame frame;
    ASSERT_TRUE(source->read(frame, milliseconds(0)));
    EXPECT_EQ(frame.t_ns, 1'234'567'000);
    EXPECT_EQ(frame.image.width, 4);
    EXPECT_EQ(frame.image.height, 2);
    EXPECT_EQ(frame.image.pixels, luma);
    EXPECT_FALSE(source->read(frame, milliseconds(0)));
  };
  check(V4L2_PIX_FMT_GREY, {10, 20, 30, 40, 50, 60, 70, 80}, 0);
  check(V4L2_PIX_FMT_GREY, {10, 20, 30, 40, 0, 0, 50, 60, 70, 80}, 6);  // the last line's filling may be missing
  check(V4L2_PIX_FMT_YUYV, {10, 0, 20, 0, 30, 0, 40, 0, 50, 0, 60, 0, 70, 0, 80, 0}, 0);
  check(V4L2_PIX_FMT_UYVY, {0, 10, 0, 20, 0, 30, 0, 40, 0, 50, 0, 60, 0, 70, 0, 80}, 0);
}

TEST(OpenV4l2, MotionJpeg) {
  FakeCamera camera = small(V4L2_PIX_FMT_MJPEG);
  camera.modes[0].width = 64;
  camera.modes[0].height = 48;
  const std::vector<unsigned char> jpeg = testkit::encode_jpeg(64, 48, std::vector<std::uint8_t>(64 * 48, 90));
  std::vector<unsigned char> cut(jpeg.begin(), jpeg.begin() + static_cast<std::ptrdiff_t>(jpeg.size() / 2));
  camera.frames = {frame_of(jpeg, 1), frame_of(cut, 2), frame_of({}, 3), frame_of(jpeg, 4)};
  const auto source = open(camera);
  CameraFrame frame;
  ASSERT_TRUE(source->read(frame, milliseconds(0)));
  EXPECT_NEAR(frame.image.at(30, 20), 90, 2);
  ASSERT_TRUE(source->read(frame, milliseconds(60'000)));
  EXPECT_EQ(frame.t_ns, 4000);
  EXPECT_THAT(source->warnings(), Contains("2 damaged images were passed over"));
}

TEST(OpenV4l2, DamagedBuffersArePassedOver) {
  FakeCamera camera = small(V4L2_PIX_FMT_GREY);
  const std::vector<unsigned char> bytes(8, 7);
  FakeCamera::Frame flagged = frame_of(bytes, 100), fault = frame_of(bytes, 200);
  flagged.flags |= V4L2_BUF_FLAG_ERROR;
  fault.failure = EIO;
  camera.frames = {flagged, frame_of({1, 2, 3}, 150), fault, frame_of(bytes, 300), frame_of(bytes, 300)};
  for (int i = 0; i < 20; ++i) camera.frames.push_back(frame_of(bytes, 400 + i));  // buffers go round
  const auto source = open(camera);
  CameraFrame frame;
  ASSERT_TRUE(source->read(frame, milliseconds(60'000)));
  EXPECT_EQ(frame.t_ns, 300'000);
  for (int i = 0; i < 20; ++i) {
    ASSERT_TRUE(source->read(frame, milliseconds(60'000)));
    EXPECT_EQ(frame.t_ns, (400 + i) * 1000);
  }
  EXPECT_THAT(source->warnings(), Contains("3 damaged images were passed over"));
}

TEST(OpenV4l2, StampsOfAnotherClockAreReplaced) {
  FakeCamera camera = small(V4L2_PIX_FMT_GREY);
  camera.frames = {frame_of(std::vector<unsigned char>(8, 7), 5)};
  camera.frames[0].flags = V4L2_BUF_FLAG_TIMESTAMP_UNKNOWN;
  const auto source = open(camera);
  const std::int64_t before_ns = host_now_ns();
  CameraFrame frame;
  ASSERT_TRUE(source->read(frame, milliseconds(0)));
  EXPECT_GE(frame.t_ns, before_ns);
  EXPECT_LE(frame.t_ns, host_now_ns());
  EXPECT_THAT(source->warnings(), Contains(HasSubstr("another clock")));
}

TEST(OpenV4l2, UnpluggedWhileOpen) {
  FakeCamera camera = small(V4L2_PIX_FMT_GREY);
  camera.frames = {frame_of(std::vector<unsigned char>(8, 7), 5)};
  {
    const auto source = open(camera);
    CameraFrame frame;
    ASSERT_TRUE(source->read(frame, milliseconds(0)));
    camera.unplugged = true;
    EXPECT_THAT([&] { source->read(frame, milliseconds(60'000)); },
                ThrowsMessage<LinkLost>(HasSubstr("was unplugged")));
  }
  EXPECT_EQ(camera.mapped, 0);
  EXPECT_EQ(camera.open_files, 0);
  EXPECT_FALSE(camera.streaming);
}

TEST(OpenV4l2, AFaultThatStaysEndsTheStream) {
  FakeCamera camera = small(V4L2_PIX_FMT_GREY);
  FakeCamera::Frame fault;
  fault.failure = EIO;
  camera.frames.assign(200, fault);
  const auto source = open(camera);
  CameraFrame frame;
  EXPECT_THROW(source->read(frame, milliseconds(60'000)), LinkLost);
}

TEST(OpenV4l2, SaysWhyItCannotBeOpened) {
  const auto refuses = [](FakeCamera camera, const V4l2Config& config, const std::string& part) {
    EXPECT_THAT([&] { open(camera, config); }, ThrowsMessage<Error>(HasSubstr(part)));
    EXPECT_EQ(camera.open_files, 0);
    EXPECT_EQ(camera.mapped, 0);
  };
  FakeCamera camera = small(V4L2_PIX_FMT_YUYV);
  camera.open_failure = EBUSY;
  refuses(camera, {}, "used by another program");
  camera = small(V4L2_PIX_FMT_YUYV);
  camera.format_failure = EBUSY;
  refuses(camera, {}, "used by another program");
  camera = small(V4L2_PIX_FMT_YUYV);
  camera.buffer_failure = EBUSY;
  refuses(camera, {}, "used by another program");
  camera = small(V4L2_PIX_FMT_YUYV);
  camera.capabilities = V4L2_CAP_META_CAPTURE;
  refuses(camera, {}, "does not capture images");
  camera = small(V4L2_PIX_FMT_H264);
  refuses(camera, {}, "no images of 4x2 that could be used (grey, yuyv, uyvy, mjpg); it has H264 4x2 at 120 Hz");
  camera = small(V4L2_PIX_FMT_YUYV);
  refuses(camera, {.width = 640, .height = 480}, "no images of 640x480");
  refuses(camera, {.rate_Hz = 200.0}, "no images of 4x2 at 200 Hz");
  camera.forced_fourcc = V4L2_PIX_FMT_NV12;
  refuses(camera, {}, "gives NV12 4x2 where YUYV 4x2 was asked for");
}

TEST(OpenV4l2, ChoosesTheFormatThatReachesTheRate) {
  FakeCamera camera;
  add_controls(camera);
  camera.modes = {{V4L2_PIX_FMT_YUYV, 640, 480, {{1, 30}}}, {V4L2_PIX_FMT_MJPEG, 640, 480, {{1, 120}}}};
  open(camera, {.width = 640, .height = 480, .rate_Hz = 120.0});
  EXPECT_EQ(camera.format.pixelformat, static_cast<std::uint32_t>(V4L2_PIX_FMT_MJPEG));
  open(camera, {.width = 640, .height = 480, .rate_Hz = 30.0});
  EXPECT_EQ(camera.format.pixelformat, static_cast<std::uint32_t>(V4L2_PIX_FMT_YUYV));
}

TEST(OpenV4l2, AFileIsNoVideoDevice) {
  EXPECT_THAT([] { open_v4l2("/proc/self/status"); }, ThrowsMessage<Error>(HasSubstr("is not a video device")));
  EXPECT_THAT([] { open_v4l2("/dev/video-that-is-not"); }, ThrowsMessage<Error>(HasSubstr("cannot be opened")));
}

}  // namespace
}  // namespace asperity
