#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>

#include "asperity/base/error.h"
#include "asperity/base/random.h"
#include "asperity/image/read_gray_image.h"
#include "asperity/tracking/aruco_dictionary.h"
#include "asperity/tracking/detect_aruco.h"

namespace asperity {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

const std::filesystem::path kBoard = std::filesystem::path(ASPERITY_TEST_DATA) / "aruco_board";

std::string small_dictionary(const std::string& change = "") {
  return change + "nmarkers: 2\nmarkersize: 3\nmarker_0: \"110100000\"\nmarker_1: 000010011\n";
}

TEST(ArucoDictionary, ReadsItsFile) {
  const ArucoDictionary board = read_aruco_dictionary(kBoard / "dictionary.yml");
  EXPECT_EQ(board.bits, 6);
  ASSERT_EQ(board.markers.size(), 35u);
  EXPECT_THAT(std::vector<int>(board.markers[0].begin(), board.markers[0].begin() + 6),
              testing::ElementsAre(1, 0, 1, 0, 1, 1));
  EXPECT_EQ(board.correctable_bits, 5);

  const ArucoDictionary given = parse_aruco_dictionary(
      "%YAML:1.0\r\n---\r\n# none\r\nmarker_0: 1100\r\nmaxCorrectionBits: 0\nmarkersize: 2\nnmarkers: 1", "d");
  EXPECT_EQ(given.correctable_bits, 0);
  EXPECT_THAT(given.markers.at(0), testing::ElementsAre(1, 1, 0, 0));
}

TEST(ArucoDictionary, SaysWhatIsWrong) {
  const auto refuses = [](const std::string& text, const std::string& part) {
    EXPECT_THAT([&] { parse_aruco_dictionary(text, "d.yml"); },
                ThrowsMessage<Error>(testing::AllOf(testing::StartsWith("d.yml:"), HasSubstr(part))));
  };
  EXPECT_NO_THROW(parse_aruco_dictionary(small_dictionary(), "d.yml"));
  refuses("", "nmarkers is missing");
  refuses("nmarkers: 1\n", "markersize is missing");
  refuses("nmarkers: 1\nmarkersize: 3\n", "marker_0 is missing");
  refuses("nmarkers: 2001\n", "d.yml:1: 'nmarkers': '2001' is not a whole number from 1 to 2000");
  refuses("nmarkers: 1\nmarkersize: 17\n", "d.yml:2: 'markersize': '17'");
  refuses(small_dictionary("nmarkers: 2\n"), "d.yml:2: 'nmarkers' is given twice");
  refuses(small_dictionary("marker_00: 110100000\n"), "marker_0 is given twice");
  refuses(small_dictionary("marker_2: 110100000\n"), "marker_2 is beyond nmarkers, 2");
  refuses(small_dictionary("colour: red\n"), "unknown key 'colour'");
  refuses(small_dictionary("- a list\n"), "is not KEY: VALUE");
  refuses("nmarkers: 1\nmarkersize: 3\nmarker_0: 11010000\n", "d.yml:3: marker_0: '11010000' is not 9 times 0 or 1");
  refuses("nmarkers: 1\nmarkersize: 3\nmarker_0: 110100002\n", "is not 9 times 0 or 1");
  refuses("nmarkers: 1\nmarkersize: 3\nmarker_0: 111101111\n", "marker_0 looks the same after a rotation");
  refuses("nmarkers: 2\nmarkersize: 2\nmarker_0: 1000\nmarker_1: 0001\n", "marker_0 and marker_1 look the same");
}

TEST(ArucoDictionary, PredefinedOnes) {
  const ArucoDictionary d = predefined_aruco_dictionary("DICT_4X4_50");
  EXPECT_EQ(d.bits, 4);
  EXPECT_EQ(d.markers.size(), 50u);
  EXPECT_THAT([] { predefined_aruco_dictionary("DICT_9X9"); }, ThrowsMessage<Error>(HasSubstr("DICT_6X6_250")));
}

// The photograph: all 35 within 2 px of the corners that OpenCV's test knows within 1 px.
TEST(DetectAruco, BoardOnAPhotograph) {
  const ArucoDetector detector(read_aruco_dictionary(kBoard / "dictionary.yml"));
  const std::vector<TagDetection> found = detector.detect(read_gray_image(kBoard / "gboriginal.png"));
  const nlohmann::json truth = nlohmann::json::parse(std::ifstream(kBoard / "gboriginal.json"))["corners"];
  ASSERT_EQ(found.size(), 35u);
  double largest_px = 0.0, squares_px2 = 0.0;
  for (int id = 0; id < 35; ++id) {
    const TagDetection& tag = found[static_cast<std::size_t>(id)];
    ASSERT_EQ(tag.id, id);
    for (int k = 0; k < 4; ++k) {
      const auto& corners = truth[static_cast<std::size_t>(id)];
      const Eigen::Vector2d expected(corners[static_cast<std::size_t>(2 * k)].get<double>(),
                                     corners[static_cast<std::size_t>(2 * k + 1)].get<double>());
      const double error_px = (tag.corners_px.col(k) - expected).norm();
      largest_px = std::max(largest_px, error_px);
      squares_px2 += error_px * error_px;
    }
  }
  std::printf("aruco board: largest %.2f px, RMS %.2f px\n", largest_px, std::sqrt(squares_px2 / 140.0));
  EXPECT_LE(largest_px, 2.0);
  // The published corners are known to 1 px.
  EXPECT_LE(std::sqrt(squares_px2 / 140.0), 1.0);
}

// A marker of `dictionary` under the homography that maps its corners to `corners_px`, 16 samples a pixel.
GrayImage rendered(const ArucoDictionary& dictionary, int id, const Eigen::Matrix<double, 2, 4>& corners_px,
                   Random& random) {
  // The homography from the unit square: x = (a u + b v + c) / (g u + h v + 1), by its closed form (Heckbert, 1989).
  const Eigen::Vector2d p0 = corners_px.col(0), p1 = corners_px.col(1), p2 = corners_px.col(2), p3 = corners_px.col(3);
  const Eigen::Vector2d s = p0 - p1 + p2 - p3, d1 = p1 - p2, d2 = p3 - p2;
  const double det = d1.x() * d2.y() - d1.y() * d2.x();
  const double g = (s.x() * d2.y() - s.y() * d2.x()) / det, h = (d1.x() * s.y() - d1.y() * s.x()) / det;
  Eigen::Matrix3d to_image;
  to_image.col(0) << p1 - p0 + g * p1, g;
  to_image.col(1) << p3 - p0 + h * p3, h;
  to_image.col(2) << p0, 1.0;
  const Eigen::Matrix3d to_marker = to_image.inverse();

  GrayImage out{320, 240, {}};
  const int cells = dictionary.bits + 2;
  const auto& marker = dictionary.markers[static_cast<std::size_t>(id)];
  for (int row = 0; row < out.height; ++row) {
    for (int column = 0; column < out.width; ++column) {
      double sum = 0.0;
      for (int k = 0; k < 16; ++k) {
        const Eigen::Vector3d p =
            to_marker * Eigen::Vector3d(column - 0.375 + 0.25 * (k % 4), row - 0.375 + 0.25 * (k / 4), 1.0);
        const int u = static_cast<int>(std::floor(p.x() / p.z() * cells)) - 1;
        const int v = static_cast<int>(std::floor(p.y() / p.z() * cells)) - 1;
        const bool outside = u < -1 || v < -1 || u > dictionary.bits || v > dictionary.bits;
        const bool inside = u >= 0 && v >= 0 && u < dictionary.bits && v < dictionary.bits;
        const bool white = outside || (inside && marker[static_cast<std::size_t>(v * dictionary.bits + u)] != 0);
        sum += white ? 210.0 : 40.0;
      }
      out.pixels.push_back(static_cast<std::uint8_t>(sum / 16.0 + 3.0 * random.normal()));
    }
  }
  return out;
}

TEST(DetectAruco, CornersOfRenderedMarkers) {
  const ArucoDictionary dictionary = predefined_aruco_dictionary("DICT_5X5_100");
  const ArucoDetector detector(dictionary);
  Random random(7);
  Eigen::Vector2d mean_px = Eigen::Vector2d::Zero();
  double squares_px2 = 0.0, outward_px = 0.0;
  constexpr int kTrials = 40;
  for (int trial = 0; trial < kTrials; ++trial) {
    const double half_px = random.uniform(25.0, 80.0), angle = random.uniform(0.0, 6.283185307179586);
    const Eigen::Vector2d middle(160.0 + random.uniform(-3.0, 3.0), 120.0 + random.uniform(-3.0, 3.0));
    Eigen::Matrix<double, 2, 4> corners_px;
    for (int k = 0; k < 4; ++k) {
      const double turn = angle + k * 1.5707963267948966;
      corners_px.col(k) = middle + half_px * Eigen::Vector2d(std::cos(turn), std::sin(turn)) +
                          0.1 * half_px * Eigen::Vector2d(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
    }
    const int id = trial;
    const std::vector<TagDetection> found = detector.detect(rendered(dictionary, id, corners_px, random));
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].id, id);
    for (int k = 0; k < 4; ++k) {
      const Eigen::Vector2d error_px = found[0].corners_px.col(k) - corners_px.col(k);
      mean_px += error_px / (4.0 * kTrials);
      squares_px2 += error_px.squaredNorm() / (4.0 * kTrials);
      outward_px += error_px.dot((corners_px.col(k) - middle).normalized()) / (4.0 * kTrials);
    }
  }
  std::printf("rendered markers: RMS %.3f px, mean (%.3f, %.3f) px, outward %.3f px\n", std::sqrt(squares_px2),
              mean_px.x(), mean_px.y(), outward_px);
  EXPECT_LT(std::sqrt(squares_px2), 0.06);  // noise of 2 % of the contrast along sides of 35 to 110 px
  EXPECT_LT(mean_px.norm(), 0.02);          // the pixel's centre is where it is said to be
  EXPECT_LT(std::abs(outward_px), 0.02);    // no bias in size, thus none in depth
}

TEST(DetectAruco, NothingInNoiseOrATinyImage) {
  const ArucoDetector detector(predefined_aruco_dictionary("DICT_4X4_50"));
  Random random(3);
  GrayImage noise{200, 150, {}};
  for (int i = 0; i < 200 * 150; ++i) noise.pixels.push_back(static_cast<std::uint8_t>(random.bits()));
  EXPECT_TRUE(detector.detect(noise).empty());
  EXPECT_TRUE(detector.detect({8, 8, std::vector<std::uint8_t>(64)}).empty());
}

}  // namespace
}  // namespace asperity
