#include "asperity/tracking/detect_tags.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include <apriltag.h>
#include <tag16h5.h>
#include <tag25h9.h>
#include <tag36h11.h>
#include <tagStandard41h12.h>

#include "asperity/base/error.h"

namespace asperity {
namespace {

using testing::HasSubstr;

struct Drawn {
  GrayImage image;
  int total = 0, border = 0;  // cells
};

// The library's own picture, upright, each cell `cell_px` wide, its top left pixel at `at`.
Drawn draw_by_library(apriltag_family_t* family, int id, int cell_px, int at, int grey) {
  image_u8_t* picture = apriltag_to_image(family, id);
  Drawn out;
  out.total = family->total_width;
  out.border = family->width_at_border;
  out.image.width = out.image.height = 2 * at + cell_px * out.total;
  out.image.pixels.assign(static_cast<std::size_t>(out.image.width * out.image.height),
                          static_cast<std::uint8_t>(grey));
  for (int row = 0; row < cell_px * out.total; ++row) {
    for (int column = 0; column < cell_px * out.total; ++column) {
      const bool white = picture->buf[(row / cell_px) * picture->stride + column / cell_px] > 0;
      out.image.pixels[static_cast<std::size_t>((row + at) * out.image.width + column + at)] = white ? 230 : 20;
    }
  }
  // Debian's library does not export its own function for this.
  std::free(picture->buf);
  std::free(picture);
  return out;
}

struct Case {
  const char* name;
  apriltag_family_t* (*create)();
  void (*destroy)(apriltag_family_t*);
};

class DetectTags : public testing::TestWithParam<Case> {};

TEST_P(DetectTags, CornersOfAnUprightTagBeginAtTheTopLeft) {
  apriltag_family_t* family = GetParam().create();
  constexpr int kCell_px = 12, kAt = 30, kId = 5;
  const Drawn drawn = draw_by_library(family, kId, kCell_px, kAt, 230);
  GetParam().destroy(family);
  const auto detector = make_tag_detector(GetParam().name);
  std::vector<TagDetection> found;
  detector->detect(drawn.image, whole(drawn.image), found);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].id, kId);
  // The border's first pixel has its centre at `first`, so the edge is half a pixel before.
  const double first = kAt + kCell_px * (drawn.total - drawn.border) / 2;
  const double low = first - 0.5, high = low + kCell_px * drawn.border;
  Eigen::Matrix<double, 2, 4> expected;
  expected << low, high, high, low, low, low, high, high;
  // What AprilTag's own line fits leave.
  EXPECT_LT((found[0].corners_px - expected).cwiseAbs().maxCoeff(), 0.3) << found[0].corners_px;
}

TEST_P(DetectTags, ThePatternIsTheLibrarysPicture) {
  apriltag_family_t* family = GetParam().create();
  const auto detector = make_tag_detector(GetParam().name);
  for (const int id : {0, 7, 22}) {
    const Drawn drawn = draw_by_library(family, id, 1, 0, 0);
    const auto pattern = detector->pattern(id);
    ASSERT_TRUE(pattern);
    ASSERT_EQ(pattern->cells, drawn.total);
    EXPECT_EQ(pattern->border_cells(), drawn.border);
    for (int row = 0; row < drawn.total; ++row) {
      for (int column = 0; column < drawn.total; ++column) {
        EXPECT_EQ(pattern->is_white(column, row), drawn.image.at(column, row) > 127);
      }
    }
  }
  GetParam().destroy(family);
  EXPECT_FALSE(detector->pattern(-1));
  EXPECT_FALSE(detector->pattern(1'000'000));
}

TEST_P(DetectTags, ARegionGivesThePixelsOfTheWholeImage) {
  apriltag_family_t* family = GetParam().create();
  const Drawn drawn = draw_by_library(family, 3, 12, 60, 230);
  GetParam().destroy(family);
  const auto detector = make_tag_detector(GetParam().name);
  std::vector<TagDetection> all, part;
  detector->detect(drawn.image, whole(drawn.image), all);
  detector->detect(drawn.image, {30, 27, drawn.image.width - 5, drawn.image.height - 11}, part);
  ASSERT_EQ(all.size(), 1U);
  ASSERT_EQ(part.size(), 1U);
  EXPECT_LT((all[0].corners_px - part[0].corners_px).cwiseAbs().maxCoeff(), 0.2);
}

INSTANTIATE_TEST_SUITE_P(Families, DetectTags,
                         testing::Values(Case{"tag36h11", tag36h11_create, tag36h11_destroy},
                                         Case{"tag25h9", tag25h9_create, tag25h9_destroy},
                                         Case{"tag16h5", tag16h5_create, tag16h5_destroy},
                                         Case{"tagStandard41h12", tagStandard41h12_create, tagStandard41h12_destroy}),
                         [](const testing::TestParamInfo<Case>& tested) { return std::string(tested.param.name); });

TEST(DetectTagsErrors, AFamilyThatIsNotKnownIsNamed) {
  try {
    make_tag_detector("tag\n99");
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("tag\\x0a99"));
    EXPECT_THAT(error.what(), HasSubstr("tag36h11"));
  }
}

TEST(DetectTagsErrors, ARegionOutsideTheImageIsRefusedAndASmallOneIsEmpty) {
  GrayImage image{64, 48, std::vector<std::uint8_t>(64 * 48, 100)};
  const auto detector = make_tag_detector("tag36h11");
  std::vector<TagDetection> found;
  EXPECT_THROW(detector->detect(image, {0, 0, 65, 48}, found), Error);
  EXPECT_THROW(detector->detect(image, {-1, 0, 64, 48}, found), Error);
  detector->detect(image, {10, 10, 14, 40}, found);
  detector->detect(image, {10, 10, 10, 10}, found);
  detector->detect(image, whole(image), found);
  EXPECT_TRUE(found.empty());
}

}  // namespace
}  // namespace asperity
