#include "asperity/camera/open_image_folder.h"

#include <gmock/gmock.h>
#include <algorithm>
#include <cstdlib>
#include <fstream>

#include "asperity/image/png_image.h"
#include "asperity/testkit/encode_jpeg.h"
#include "asperity/testkit/temp_dir.h"
#include "asperity/transport/byte_source.h"

namespace asperity {
namespace {

using std::chrono::milliseconds;
using testing::HasSubstr;
using testing::ThrowsMessage;

// A folder of images whose first pixel is their number in `names`, from 1.
void make_images(const testkit::TempDir& dir, const std::vector<std::string>& names) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    GrayImage image{6, 4, std::vector<std::uint8_t>(24, static_cast<std::uint8_t>(i + 1))};
    std::string bytes = format_png(image);
    if (names[i].ends_with(".pgm")) bytes = "P5 6 4 255\n" + std::string(image.pixels.begin(), image.pixels.end());
    if (names[i].ends_with(".JPG")) {
      const auto jpeg = testkit::encode_jpeg(6, 4, image.pixels);
      bytes.assign(jpeg.begin(), jpeg.end());
    }
    std::ofstream(dir / names[i], std::ios::binary) << bytes;
  }
}

TEST(ImageFolder, NamesAreTimes) {
  const testkit::TempDir dir;
  make_images(dir, {"30000000.png", "9000000.png", "1000000.pgm"});
  std::ofstream(dir / "notes.txt") << "not an image";
  const auto camera = open_image_folder(dir.path());
  CameraFrame frame;
  std::vector<std::pair<std::int64_t, int>> seen;
  for (int i = 0; i < 3; ++i) {
    ASSERT_TRUE(camera->read(frame, milliseconds(0)));
    seen.emplace_back(frame.t_ns, frame.image.at(5, 3));
  }
  EXPECT_THAT(seen, testing::ElementsAre(testing::Pair(1'000'000, 3), testing::Pair(9'000'000, 2),
                                         testing::Pair(30'000'000, 1)));
  EXPECT_THROW(camera->read(frame, milliseconds(0)), LinkLost);
}

TEST(ImageFolder, WithARateNumbersInNamesCountByValue) {
  const testkit::TempDir dir;
  make_images(dir, {"shot10.png", "shot9.png", "shot009a.png", "Shot1.JPG"});
  const auto camera = open_image_folder(dir.path(), {40.0});
  EXPECT_EQ(camera->nominal_rate_Hz(), 40.0);
  CameraFrame frame;
  std::vector<std::pair<std::int64_t, int>> seen;
  for (int i = 0; i < 4; ++i) {
    ASSERT_TRUE(camera->read(frame, milliseconds(0)));
    seen.emplace_back(frame.t_ns, frame.image.at(0, 0));
  }
  EXPECT_THAT(seen, testing::ElementsAre(testing::Pair(0, 4), testing::Pair(25'000'000, 2),
                                         testing::Pair(50'000'000, 3), testing::Pair(75'000'000, 1)));
}

TEST(ImageFolder, ADamagedImageIsNamedAndPassedOver) {
  const testkit::TempDir dir;
  make_images(dir, {"1.png", "3.png"});
  std::ofstream(dir / "2.png", std::ios::binary)
      << format_png(GrayImage{40, 30, std::vector<std::uint8_t>(1200)}).substr(0, 60);
  const auto camera = open_image_folder(dir.path(), {10.0});
  CameraFrame frame;
  ASSERT_TRUE(camera->read(frame, milliseconds(0)));
  EXPECT_THAT([&] { camera->read(frame, milliseconds(0)); },
              ThrowsMessage<Error>(HasSubstr("2.png: the image is damaged")));
  ASSERT_TRUE(camera->read(frame, milliseconds(0)));
  EXPECT_EQ(frame.t_ns, 200'000'000);
}

TEST(ImageFolder, RefusesWhatHasNoTimes) {
  const auto refuses = [](const std::vector<std::string>& names, const ImageFolderConfig& config,
                          const std::string& part) {
    const testkit::TempDir dir;
    make_images(dir, names);
    EXPECT_THAT([&] { open_image_folder(dir.path(), config); }, ThrowsMessage<Error>(HasSubstr(part)));
  };
  refuses({}, {}, "holds no image");
  refuses({"a.png"}, {}, "a.png is not a time in ns; give the images a rate");
  refuses({"1.png", "2.png", "3.png"}, {}, "they would be 1 ns apart");
  refuses({"1000.png", "1000.pgm"}, {}, "have the same time");
  refuses({"1.png"}, {-1.0}, "-1 Hz");
  EXPECT_THAT([] { open_image_folder("/nonexistent/folder"); }, ThrowsMessage<Error>(HasSubstr("cannot be read")));
}

}  // namespace
}  // namespace asperity
