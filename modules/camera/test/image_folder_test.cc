#include "asperity/camera/open_image_folder.h"

#include <gmock/gmock.h>
#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <opencv2/imgcodecs.hpp>

#include "asperity/image/read_gray_image.h"
#include "asperity/testkit/temp_dir.h"
#include "asperity/transport/byte_source.h"

namespace asperity {
namespace {

using std::chrono::milliseconds;
using testing::HasSubstr;
using testing::ThrowsMessage;

cv::Mat gradient(int width, int height) {
  cv::Mat out(height, width, CV_8UC1);
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      out.at<unsigned char>(row, column) = static_cast<unsigned char>(3 * column + row);
    }
  }
  return out;
}

std::vector<unsigned char> encoded(const std::string& extension) {
  std::vector<unsigned char> out;
  cv::imencode(extension, gradient(40, 30), out);
  return out;
}

void write(const std::filesystem::path& path, std::span<const unsigned char> bytes) {
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

// A folder of images whose first pixel is their number in `names`, from 1.
void make_images(const testkit::TempDir& dir, const std::vector<std::string>& names) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    cv::imwrite((dir / names[i]).string(), cv::Mat(4, 6, CV_8UC1, cv::Scalar(static_cast<double>(i + 1))));
  }
}

TEST(ReadGrayImage, FormatsThatKeepEveryPixel) {
  const cv::Mat truth = gradient(40, 30);
  for (const std::string extension : {".png", ".pgm"}) {
    const GrayImage image = decode_gray_image(encoded(extension), extension);
    ASSERT_EQ(image.width, 40);
    ASSERT_EQ(image.height, 30);
    EXPECT_TRUE(std::equal(image.pixels.begin(), image.pixels.end(), truth.begin<unsigned char>()));
  }
  const GrayImage jpeg = decode_gray_image(encoded(".jpg"), "jpeg");
  int worst = 0;
  for (int i = 0; i < 40 * 30; ++i)
    worst = std::max(worst, std::abs(jpeg.at(i % 40, i / 40) - truth.at<unsigned char>(i / 40, i % 40)));
  EXPECT_LE(worst, 8);  // gray levels lost to quality 95
}

TEST(ReadGrayImage, DamagedImagesAreRefused) {
  for (const std::string extension : {".png", ".pgm", ".jpg"}) {
    const std::vector<unsigned char> whole = encoded(extension);
    for (std::size_t size = 0; size < whole.size(); size += 1 + whole.size() / 50) {
      const std::vector<unsigned char> cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
      EXPECT_THAT([&] { decode_gray_image(cut, "cut"); }, ThrowsMessage<Error>(testing::StartsWith("cut: ")))
          << extension << " cut to " << size;
    }
  }
}

TEST(ReadGrayImage, SizesAreBoundedBeforeDecoding) {
  const std::string pgm = "P5\n# a comment\n8193 1\n255\n" + std::string(8193, 'x');
  const auto bytes = [](const std::string& text) {
    return std::span(reinterpret_cast<const unsigned char*>(text.data()), text.size());
  };
  EXPECT_THAT([&] { decode_gray_image(bytes(pgm), "x.pgm"); },
              ThrowsMessage<Error>(testing::AllOf(HasSubstr("x.pgm: "), HasSubstr("8193 x 1"))));
  std::vector<unsigned char> png = encoded(".png");
  png[16] = 0x7f;  // the width's highest byte
  EXPECT_THAT([&] { decode_gray_image(png, "x.png"); }, ThrowsMessage<Error>(HasSubstr("2130706472 x 30")));
  std::vector<unsigned char> jpeg = encoded(".jpg");
  const std::vector<unsigned char> frame = {0xff, 0xc0};
  const auto at = std::search(jpeg.begin(), jpeg.end(), frame.begin(), frame.end());
  ASSERT_NE(at, jpeg.end());
  at[5] = 0xff;  // the height
  EXPECT_THAT([&] { decode_gray_image(jpeg, "x.jpg"); }, ThrowsMessage<Error>(HasSubstr("40 x 65310")));
  EXPECT_THAT([&] { decode_gray_image(bytes("GIF89a"), "x.gif"); }, ThrowsMessage<Error>(HasSubstr("not an image")));
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
  const std::vector<unsigned char> whole = encoded(".png");
  write(dir / "2.png", std::span(whole).first(60));
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
  refuses({}, {}, "there is no image");
  refuses({"a.png"}, {}, "a.png is not a time in ns; give the images a rate");
  refuses({"1.png", "2.png", "3.png"}, {}, "they would be 1 ns apart");
  refuses({"1000.png", "1000.pgm"}, {}, "have the same time");
  refuses({"1.png"}, {-1.0}, "-1 Hz");
  EXPECT_THAT([] { open_image_folder("/nonexistent/folder"); }, ThrowsMessage<Error>(HasSubstr("cannot be read")));
}

}  // namespace
}  // namespace asperity
