#include "asperity/camera/open_y4m.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>
#include <csignal>
#include <fstream>
#include <thread>

#include "asperity/base/host_clock.h"
#include "asperity/image/y4m.h"
#include "asperity/testkit/temp_dir.h"
#include "asperity/transport/byte_source.h"

namespace asperity {
namespace {

using std::chrono::milliseconds;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr milliseconds kLong{60'000};  // never waited for in full

Y4mHeader header(int width, int height, std::int64_t rate = 120) {
  Y4mHeader out;
  out.width = width;
  out.height = height;
  out.rate_numerator = rate;
  return out;
}

GrayImage ramp(int width, int height, int offset) {
  GrayImage out{width, height, {}};
  for (int i = 0; i < width * height; ++i) out.pixels.push_back(static_cast<std::uint8_t>(i + offset));
  return out;
}

std::string file_of(const testkit::TempDir& dir, const std::string& content) {
  const auto path = dir / "in.y4m";
  std::ofstream(path, std::ios::binary) << content;
  return path.string();
}

TEST(OpenY4m, FileWithTimes) {
  const testkit::TempDir dir;
  std::string stream = format_y4m_header(header(300, 257));
  for (int i = 0; i < 3; ++i) append_y4m_frame(stream, header(300, 257), ramp(300, 257, i), 1'000'000'007LL * (i + 1));
  const auto camera = open_y4m(file_of(dir, stream));
  EXPECT_EQ(camera->nominal_rate_Hz(), 120.0);
  CameraFrame frame;
  for (int i = 0; i < 3; ++i) {
    ASSERT_TRUE(camera->read(frame, kLong));
    EXPECT_EQ(frame.t_ns, 1'000'000'007LL * (i + 1));
    EXPECT_EQ(frame.image.width, 300);
    EXPECT_EQ(frame.image.height, 257);
    EXPECT_EQ(frame.image.pixels, ramp(300, 257, i).pixels);
  }
  for (int i = 0; i < 2; ++i) {
    EXPECT_THAT([&] { camera->read(frame, kLong); }, ThrowsMessage<LinkLost>(HasSubstr("after frame 3")));
  }
}

TEST(OpenY4m, FileWithoutTimesGoesByItsRateAndPassesChromaOver) {
  const testkit::TempDir dir;
  const std::string stream = "YUV4MPEG2 W3 H3 F30000:1001 C420jpeg\nFRAME\nabcdefghiUUUUVVVVFRAME\nABCDEFGHIuuuuvvvv";
  const auto camera = open_y4m(file_of(dir, stream));
  CameraFrame frame;
  ASSERT_TRUE(camera->read(frame, kLong));
  EXPECT_EQ(frame.t_ns, 0);
  ASSERT_TRUE(camera->read(frame, kLong));
  EXPECT_EQ(frame.t_ns, 33'366'667);  // 1001/30000 s
  EXPECT_EQ(std::string(frame.image.pixels.begin(), frame.image.pixels.end()), "ABCDEFGHI");
}

TEST(OpenY4m, SaysWhereAStreamIsWrong) {
  const testkit::TempDir dir;
  const auto second_frame = [&](const std::string& stream, const std::string& part) {
    const auto camera = open_y4m(file_of(dir, "YUV4MPEG2 W2 H1 Cmono" + stream));
    CameraFrame frame;
    ASSERT_TRUE(camera->read(frame, kLong));
    EXPECT_THAT([&] { camera->read(frame, kLong); }, ThrowsMessage<Error>(HasSubstr(part)));
    EXPECT_THROW(camera->read(frame, kLong), LinkLost);
  };
  second_frame("\nFRAME Xt_ns=5\nabFRAME Xt_ns=5\ncd", "frame 2: Xt_ns=5 is not after 5");
  second_frame("\nFRAME Xt_ns=5\nabFRAME\ncd", "frame 2 has no Xt_ns");
  second_frame(" F9:1\nFRAME\nabFRAME Xt_ns=6\ncd", "frame 2 has an Xt_ns");
  second_frame(" F9:1\nFRAME\nabFRAMX\ncd", "frame 2: expected FRAME, found 'FRAMX'");
  second_frame(" F9:1\nFRAME\nabFRAME\nc", "ended within frame 2");
  second_frame(" F9:1\nFRAME\nab" + std::string(2000, 'x'), "frame 2 is longer than 1024");

  CameraFrame frame;
  const auto untimed = open_y4m(file_of(dir, "YUV4MPEG2 W2 H1 Cmono\nFRAME\nab"));
  EXPECT_THAT([&] { untimed->read(frame, kLong); }, ThrowsMessage<Error>(HasSubstr("neither Xt_ns nor a rate")));
  EXPECT_THAT([&] { open_y4m(file_of(dir, "YUV4MPEG2 W2")); }, ThrowsMessage<Error>(HasSubstr("within its header")));
  EXPECT_THAT([&] { open_y4m(file_of(dir, "P5\n2 1\n")); }, ThrowsMessage<Error>(HasSubstr("not a YUV4MPEG2")));
  EXPECT_THAT([&] { open_y4m((dir / "none").string()); }, ThrowsMessage<Error>(HasSubstr("cannot be opened")));
  EXPECT_THAT([&] { open_y4m(dir.path().string()); }, ThrowsMessage<Error>(HasSubstr("is a folder")));
}

TEST(OpenY4m, FifoInPieces) {
  ::signal(SIGPIPE, SIG_IGN);
  const testkit::TempDir dir;
  const std::string path = (dir / "fifo").string();
  ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
  const auto camera = open_y4m(path);
  CameraFrame frame;
  EXPECT_FALSE(camera->read(frame, milliseconds(0)));  // no writer yet: not the end

  const int writer = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
  ASSERT_GE(writer, 0);
  const auto send = [&](const std::string& bytes) {
    ASSERT_EQ(::write(writer, bytes.data(), bytes.size()), static_cast<ssize_t>(bytes.size()));
  };
  std::string stream = format_y4m_header(header(5, 4));
  append_y4m_frame(stream, header(5, 4), ramp(5, 4, 0), 10);
  for (const char c : stream.substr(0, stream.size() - 1)) {
    send(std::string(1, c));
    EXPECT_FALSE(camera->read(frame, milliseconds(0)));
  }
  send(stream.substr(stream.size() - 1));
  ASSERT_TRUE(camera->read(frame, kLong));
  EXPECT_EQ(frame.t_ns, 10);
  EXPECT_EQ(frame.image.pixels, ramp(5, 4, 0).pixels);
  ::close(writer);
  EXPECT_THAT([&] { camera->read(frame, kLong); }, ThrowsMessage<LinkLost>(HasSubstr("after frame 1")));
}

TEST(OpenY4m, FifoWithoutTimesIsStampedAtArrival) {
  const testkit::TempDir dir;
  const std::string path = (dir / "fifo").string();
  ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
  const auto camera = open_y4m(path);
  const std::int64_t begin_ns = host_now_ns();
  std::thread writer([&] {
    std::string stream = format_y4m_header(header(640, 480));
    for (int i = 0; i < 5; ++i) append_y4m_frame(stream, header(640, 480), ramp(640, 480, i), std::nullopt);
    std::ofstream(path, std::ios::binary) << stream;
  });
  CameraFrame frame;
  std::int64_t last_ns = begin_ns;
  for (int i = 0; i < 5; ++i) {
    EXPECT_TRUE(camera->read(frame, kLong));
    EXPECT_GT(frame.t_ns, last_ns);
    EXPECT_EQ(frame.image.pixels, ramp(640, 480, i).pixels);
    last_ns = frame.t_ns;
  }
  EXPECT_LE(last_ns, host_now_ns());
  writer.join();
}

}  // namespace
}  // namespace asperity
