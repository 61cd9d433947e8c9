#include "asperity/camera/open_video.h"

#include <gmock/gmock.h>
#include <sys/wait.h>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "asperity/testkit/encode_jpeg.h"
#include "asperity/testkit/temp_dir.h"
#include "asperity/transport/byte_source.h"

namespace asperity {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

std::string path_of_programs() {
  const char* path = std::getenv("PATH");
  return path == nullptr ? "/usr/bin:/bin" : path;
}

// The test's own PATH, while it lives.
class SetPath {
 public:
  explicit SetPath(const std::string& path) { ::setenv("PATH", path.c_str(), 1); }
  ~SetPath() { ::setenv("PATH", before_.c_str(), 1); }
  SetPath(const SetPath&) = delete;
  SetPath& operator=(const SetPath&) = delete;

 private:
  std::string before_ = path_of_programs();
};

// A program `ffmpeg` in `dir` that is the shell's `lines`.
void play_ffmpeg(const testkit::TempDir& dir, const std::string& lines) {
  std::ofstream(dir / "ffmpeg") << "#!/bin/sh\n" << lines << "\n";
  fs::permissions(dir / "ffmpeg", fs::perms::owner_all);
}

// What looks like a video by its first bytes.
fs::path make_avi(const testkit::TempDir& dir) {
  std::ofstream(dir / "a.avi", std::ios::binary) << "RIFF....AVI LIST";
  return dir / "a.avi";
}

void append_value(std::string& out, std::uint32_t value, int bytes = 4) {
  for (int i = 0; i < bytes; ++i) out += static_cast<char>(value >> (8 * i));
}

std::string chunk(const std::string& name, const std::string& content) {
  std::string out = name;
  append_value(out, static_cast<std::uint32_t>(content.size()));
  out += content;
  if (content.size() % 2 != 0) out += '\0';
  return out;
}

// An AVI of Motion-JPEG, by Microsoft's description of RIFF files; images of 64 x 48, 45 a second, of one gray each.
std::string format_avi(const std::vector<int>& grays) {
  std::string header, stream, format, images, index;
  for (const std::uint32_t value :
       {22222u, 0u, 0u, 0x10u, static_cast<std::uint32_t>(grays.size()), 0u, 1u, 0u, 64u, 48u, 0u, 0u, 0u, 0u})
    append_value(header, value);
  stream = "vidsMJPG";
  for (const std::uint32_t value : {0u, 0u, 0u, 1u, 45u, 0u, static_cast<std::uint32_t>(grays.size()), 0u, ~0u, 0u})
    append_value(stream, value);
  for (const std::uint32_t value : {0u, 0u, 64u, 48u}) append_value(stream, value, 2);
  append_value(format, 40);
  append_value(format, 64);
  append_value(format, 48);
  append_value(format, 1, 2);
  append_value(format, 24, 2);
  format += "MJPG";
  for (const std::uint32_t value : {64u * 48u * 3u, 0u, 0u, 0u, 0u}) append_value(format, value);
  for (const int gray : grays) {
    const auto jpeg = testkit::encode_jpeg(64, 48, std::vector<std::uint8_t>(64 * 48, static_cast<std::uint8_t>(gray)));
    index += "00dc";
    append_value(index, 0x10);
    append_value(index, static_cast<std::uint32_t>(4 + images.size()));
    append_value(index, static_cast<std::uint32_t>(jpeg.size()));
    images += chunk("00dc", {jpeg.begin(), jpeg.end()});
  }
  const std::string lists = chunk("LIST", "hdrl" + chunk("avih", header) +
                                              chunk("LIST", "strl" + chunk("strh", stream) + chunk("strf", format))) +
                            chunk("LIST", "movi" + images) + chunk("idx1", index);
  return chunk("RIFF", "AVI " + lists);
}

TEST(OpenVideo, ImagesAndTimesOfTheContainer) {
  const testkit::TempDir dir;
  std::ofstream(dir / "a.avi", std::ios::binary) << format_avi({0, 40, 80, 120, 160, 200});
  const std::unique_ptr<CameraSource> camera =
      open_video(dir / "a.avi");  // by the ffmpeg that scripts/bootstrap installs
  EXPECT_NEAR(camera->nominal_rate_Hz(), 45.0, 1e-6);
  CameraFrame frame;
  for (int i = 0; i < 6; ++i) {
    ASSERT_TRUE(camera->read(frame, milliseconds(0)));
    EXPECT_NEAR(static_cast<double>(frame.t_ns), i * 1e9 / 45.0, 1000.0) << i;  // ns; the container counts images
    EXPECT_EQ(frame.image.width, 64);
    EXPECT_EQ(frame.image.height, 48);
    EXPECT_NEAR(frame.image.at(30, 20), 40 * i, 2);  // gray levels, after JPEG
  }
  EXPECT_THAT([&] { camera->read(frame, milliseconds(0)); },
              ThrowsMessage<LinkLost>(HasSubstr("has ended after image 6")));
}

TEST(OpenVideo, TimesOfAContainerWhoseRateChanges) {
  const testkit::TempDir dir;
  // Two images, at 3/90 s and 3.5/90 s, a third without a time, and noise beside.
  play_ffmpeg(dir,
              "printf 'YUV4MPEG2 W2 H1 F45:1 Ip Cmono\nFRAME\n\\001\\002FRAME\n\\003\\004FRAME\n\\005\\006'\n"
              "printf '#software: x\n#tb 0: 1/180\n#sar 0: 1/1\n0, 5, 6, 1, 2, 0x1\n0, 6, 7, 1, 2, 0x2\n' >&3\n"
              "echo noise >&2");
  const SetPath path(dir.path().string() + ":" + path_of_programs());
  const auto camera = open_video(make_avi(dir));
  CameraFrame frame;
  ASSERT_TRUE(camera->read(frame, milliseconds(0)));
  EXPECT_EQ(frame.t_ns, 0);
  EXPECT_EQ(frame.image.pixels, (std::vector<std::uint8_t>{1, 2}));
  ASSERT_TRUE(camera->read(frame, milliseconds(0)));
  EXPECT_EQ(frame.t_ns, 5'555'556);
  ASSERT_TRUE(camera->read(frame, milliseconds(0)));
  EXPECT_EQ(frame.t_ns, 5'555'556 + 22'222'222);
  EXPECT_THROW(camera->read(frame, milliseconds(0)), LinkLost);
}

// By its words: no shell and nothing in a name that is taken for something else.
TEST(OpenVideo, TheCommand) {
  const testkit::TempDir dir;
  play_ffmpeg(dir, "printf '%s\\n' \"$@\" > '" + (dir / "words").string() + "'; exit 1");
  const SetPath path(dir.path().string() + ":" + path_of_programs());
  const fs::path video = dir / "-i $(touch x) 'http:";
  fs::copy_file(make_avi(dir), video);
  EXPECT_THROW(open_video(video), Error);
  std::ifstream file(dir / "words");
  const std::string words((std::istreambuf_iterator<char>(file)), {});
  EXPECT_THAT(words, AllOf(HasSubstr("-i\nfile:" + video.string() + "\n"), HasSubstr("-protocol_whitelist\nfile\n"),
                           HasSubstr("-format_whitelist\navi,mov,matroska\n"), HasSubstr("-nostdin\n")));
}

TEST(OpenVideo, FaultsOfFfmpegAreNamed) {
  const testkit::TempDir dir;
  const SetPath path(dir.path().string() + ":" + path_of_programs());
  const fs::path video = make_avi(dir);
  play_ffmpeg(dir, "echo 'no such codec' >&2; exit 1");
  EXPECT_THAT([&] { open_video(video); },
              ThrowsMessage<Error>(AllOf(HasSubstr("a.avi: the video is damaged"), HasSubstr("no such codec"))));
  play_ffmpeg(dir, "printf 'YUV4MPEG2 W9000 H1 F45:1 Ip Cmono\n'; exec sleep 1000");
  EXPECT_THAT([&] { open_video(video); }, ThrowsMessage<Error>(HasSubstr("9000")));
  play_ffmpeg(dir, "printf 'YUV4MPEG2 W1 H1 F45:1 Ip Cmono\nFRAME\n1FRA'; echo 'bits are gone' >&2; exit 1");
  const auto camera = open_video(video);
  CameraFrame frame;
  ASSERT_TRUE(camera->read(frame, milliseconds(0)));
  EXPECT_THAT([&] { camera->read(frame, milliseconds(0)); },
              ThrowsMessage<LinkLost>(AllOf(HasSubstr("damaged behind image 1"), HasSubstr("bits are gone"))));
}

TEST(OpenVideo, WithoutFfmpegTheRemedyIsTold) {
  const testkit::TempDir dir;
  const SetPath path(dir.path().string());
  EXPECT_THAT([&] { open_video(make_avi(dir)); },
              ThrowsMessage<Error>(AllOf(HasSubstr("apt-get install ffmpeg"), HasSubstr("-f yuv4mpegpipe"))));
}

TEST(OpenVideo, ClosingEndsFfmpeg) {
  const testkit::TempDir dir;
  play_ffmpeg(dir,
              "echo $$ > '" + (dir / "id").string() + "'; printf 'YUV4MPEG2 W1 H1 F45:1 Ip Cmono\n'; exec sleep 1000");
  const SetPath path(dir.path().string() + ":" + path_of_programs());
  open_video(make_avi(dir)).reset();
  pid_t id = 0;
  std::ifstream(dir / "id") >> id;
  ASSERT_GT(id, 1);
  EXPECT_EQ(::kill(id, 0), -1);
  EXPECT_EQ(errno, ESRCH);
  EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1);  // nobody is left to be waited for
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
