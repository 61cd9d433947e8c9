#include "asperity/vision/vision.h"

#include <gmock/gmock.h>
#include <algorithm>
#include <cmath>

#include "asperity/vision/predefined_dictionary.h"

namespace asperity {
namespace {

TEST(Vision, OurNamesOfDictionariesAreOpencvs) {
  for (const auto& [name, bits, markers] :
       {std::tuple{"DICT_4X4_50", 4, 50}, std::tuple{"DICT_5X5_1000", 5, 1000}, std::tuple{"DICT_6X6_250", 6, 250},
        std::tuple{"DICT_7X7_100", 7, 100}, std::tuple{"DICT_ARUCO_ORIGINAL", 5, 1024},
        std::tuple{"DICT_APRILTAG_16h5", 4, 30}, std::tuple{"DICT_APRILTAG_36h11", 6, 587}}) {
    const auto dictionary = find_predefined_dictionary(name);
    ASSERT_TRUE(dictionary) << name;
    EXPECT_EQ(dictionary->markers, markers);
    const ArucoDictionary theirs = vision().predefined_dictionary(dictionary->opencv_id);
    EXPECT_EQ(theirs.bits, bits) << name;
    EXPECT_EQ(theirs.markers.size(), static_cast<std::size_t>(markers)) << name;
  }
  EXPECT_FALSE(find_predefined_dictionary("DICT_9X9_50"));
}

TEST(Vision, WhatOpencvThrowsIsCaughtOnThisSide) {
  EXPECT_THROW(vision().plane_poses({{{0.0f, 0.0f, 0.0f}}, {{1.0f, 2.0f}}}, {500, 500, 320, 240, 0, 0, 0, 0, 0}),
               VisionError);
}

// The sum of the weights exp(−r²/2σ²), which reach 3 px, over the image; those around the box count.
TEST(Vision, BlurIsAGaussianOfTheWholeImage) {
  GrayImage image{20, 20, std::vector<std::uint8_t>(400, 0)};
  image.pixels[10 * 20 + 9] = 250;
  const GrayImage out = vision().blur(image, {10, 8, 6, 5}, 0.8);
  ASSERT_EQ(out.width, 6);
  ASSERT_EQ(out.height, 5);
  double sum = 0.0;
  for (int i = -3; i <= 3; ++i) sum += std::exp(-i * i / (2.0 * 0.64));
  for (int row = 0; row < 5; ++row) {
    for (int column = 0; column < 6; ++column) {
      const int x = column + 1, y = row - 2;
      const double wanted = std::max(std::abs(x), std::abs(y)) > 3
                                ? 0.0
                                : 250.0 * std::exp(-(x * x + y * y) / (2.0 * 0.64)) / (sum * sum);
      EXPECT_NEAR(out.at(column, row), wanted, 1.0) << column << ' ' << row;
    }
  }
}

}  // namespace
}  // namespace asperity
