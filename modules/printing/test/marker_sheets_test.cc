#include "asperity/printing/marker_sheets.h"

#include <gmock/gmock.h>
#include <algorithm>
#include <map>
#include <numbers>
#include <opencv2/aruco/charuco.hpp>
#include <opencv2/calib3d.hpp>

#include "asperity/base/error.h"
#include "asperity/printing/format_pdf.h"
#include "asperity/tracking/detect_tags.h"
#include "read_pdf.h"

namespace asperity {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double kPlace_mm = 1e-4;  // PDF numbers are written to 1e-6 mm, read through points of 12 digits

constexpr double kDetected_mm = 0.0625;  // a quarter of a pixel of 4 px/mm: detectors on edges without a lens's blur

// A family through its detector, which the tests use to read the print too.
struct Family {
  std::shared_ptr<TagDetector> detector;
  TagFamily family;

  explicit Family(const std::string& name) : detector(make_tag_detector(name)) {
    family.name = name;
    family.pattern = [owned = detector](int id) { return owned->pattern(id); };
  }
  std::map<int, Eigen::Matrix<double, 2, 4>> found_mm(const PrintPage& page, double px_per_mm) const {
    const GrayImage image = rasterised(page, px_per_mm);
    std::vector<TagDetection> tags;
    detector->detect(image, whole(image), tags);
    std::map<int, Eigen::Matrix<double, 2, 4>> out;
    for (const TagDetection& tag : tags) out[tag.id] = (tag.corners_px.array() + 0.5) / px_per_mm;
    return out;
  }
};

Eigen::Matrix<double, 2, 4> square_mm(double left_mm, double top_mm, double size_mm) {
  Eigen::Matrix<double, 2, 4> out;
  out << left_mm, left_mm + size_mm, left_mm + size_mm, left_mm, top_mm, top_mm, top_mm + size_mm, top_mm + size_mm;
  return out;
}

double length_mm(const PrintLine& line) { return std::hypot(line.x1_mm - line.x0_mm, line.y1_mm - line.y0_mm); }

TEST(MarkerSheets, TagsAreWhereThePdfSaysAndAsLargeAsAsked) {
  const Family tags("tag36h11");
  const MarkerPrint print = layout_tags(tags.family, {0, 1, 2, 5}, 0.046, Paper::kA4);
  const std::vector<PrintPage> pages = read_pdf(format_pdf(print.pages, "tags"));
  ASSERT_EQ(pages.size(), 1u);
  EXPECT_NEAR(pages[0].width_mm, 210.0, kPlace_mm);
  EXPECT_NEAR(pages[0].height_mm, 297.0, kPlace_mm);
  const auto found = tags.found_mm(pages[0], 4.0);
  ASSERT_EQ(found.size(), 4u);
  // Columns 57.5 mm wide and 4 mm apart behind a margin of 20 mm; the tag is 5.75 mm inside its cell.
  const std::map<int, Eigen::Matrix<double, 2, 4>> expected = {{0, square_mm(25.75, 13.75, 46.0)},
                                                               {1, square_mm(87.25, 13.75, 46.0)},
                                                               {2, square_mm(148.75, 13.75, 46.0)},
                                                               {5, square_mm(25.75, 80.25, 46.0)}};
  for (const auto& [id, corners_mm] : found) {
    EXPECT_LT((corners_mm - expected.at(id)).cwiseAbs().maxCoeff(), kDetected_mm) << id << "\n" << corners_mm;
  }
  // The exact places, from the PDF's text: the black border's outer edges.
  const auto edge = [&](auto of) { return std::ranges::any_of(pages[0].black, of); };
  EXPECT_TRUE(edge([](const PrintRectangle& box) {
    return std::abs(box.left_mm - 25.75) < kPlace_mm && std::abs(box.top_mm - 13.75) < kPlace_mm;
  }));
  EXPECT_TRUE(edge([](const PrintRectangle& box) { return std::abs(box.left_mm + box.width_mm - 71.75) < kPlace_mm; }));
  ASSERT_EQ(print.markers.size(), 4u);
  EXPECT_NEAR(print.markers[1].T_marker_tag.translation_m.x(), 0.0615, 1e-12);
  EXPECT_NEAR(print.markers[3].T_marker_tag.translation_m.y(), 0.0665, 1e-12);
  EXPECT_THAT(pages[0].texts, testing::Contains(testing::Field(&PrintText::text, "tag36h11 id 5, 46 mm")));
}

TEST(MarkerSheets, RulersAreAHundredMillimetres) {
  for (const Paper paper : {Paper::kA4, Paper::kLetter}) {
    const Family tags("tag36h11");
    const PrintPage page = read_pdf(format_pdf(layout_tags(tags.family, {0}, 0.02, paper).pages, ""))[0];
    int rulers = 0, ticks = 0;
    for (const PrintLine& line : page.lines) {
      EXPECT_GE(std::min({line.x0_mm, line.x1_mm, line.y0_mm, line.y1_mm}), 5.0);  // what printers cannot reach
      EXPECT_LE(std::max(line.x0_mm, line.x1_mm), page.width_mm - 5.0);
      EXPECT_LE(std::max(line.y0_mm, line.y1_mm), page.height_mm - 5.0);
      if (std::abs(length_mm(line) - 100.0) < kPlace_mm) ++rulers;
      if (length_mm(line) < 6.0) ++ticks;
    }
    EXPECT_EQ(rulers, 2);
    EXPECT_EQ(ticks, 2 * 101);
  }
}

TEST(MarkerSheets, SeveralPagesAndWhatDoesNotFit) {
  const Family tags("tag36h11");
  std::vector<int> ids;
  for (int id = 0; id < 20; ++id) ids.push_back(id);
  const MarkerPrint print = layout_tags(tags.family, ids, 0.046, Paper::kLetter);
  EXPECT_EQ(print.pages.size(), 3u);  // nine a page
  EXPECT_TRUE(print.markers.empty());
  std::size_t found = 0;
  for (const PrintPage& page : print.pages) found += tags.found_mm(page, 3.0).size();
  EXPECT_EQ(found, 20u);
  EXPECT_THAT([&] { layout_tags(tags.family, {587}, 0.046, Paper::kA4); },
              ThrowsMessage<Error>(HasSubstr("no tag 587")));
  EXPECT_THAT([&] { layout_tags(tags.family, {0}, 0.2, Paper::kA4); },
              ThrowsMessage<Error>(HasSubstr("at most 145 mm do")));
  EXPECT_NO_THROW(layout_tags(tags.family, {0}, 0.145, Paper::kA4));
  EXPECT_THAT([&] { layout_tags(tags.family, {0}, 1e-4, Paper::kA4); },
              ThrowsMessage<Error>(HasSubstr("not within 2")));
  EXPECT_THAT([&] { layout_tags(tags.family, {}, 0.046, Paper::kA4); }, ThrowsMessage<Error>(HasSubstr("0 tags")));
}

// Folding the strip: from one tag to the next half a face on, a bend by 2π/n towards the inside, half a face on.
TEST(MarkerSheets, ARingsPosesAreThoseOfTheFoldedStrip) {
  for (const int sides : {3, 4, 6, 11}) {
    const Family tags("tag36h11");
    RingConfig config;
    config.sides = sides;
    config.first_id = 7;
    config.size_m = 0.02;
    config.face_m = 0.027;
    const MarkerPrint print = layout_ring(tags.family, config, Paper::kA4);
    ASSERT_EQ(print.markers.size(), static_cast<std::size_t>(sides));
    const Pose half{Eigen::Quaterniond::Identity(), {0.0135, 0.0, 0.0}};
    const Pose bend{Eigen::Quaterniond(Eigen::AngleAxisd(-2.0 * std::numbers::pi / sides, Eigen::Vector3d::UnitY())),
                    {}};
    Pose folded;
    folded.translation_m.setZero();
    for (int i = 0; i < sides; ++i) {
      const MarkerPlacement& marker = print.markers[static_cast<std::size_t>(i)];
      EXPECT_EQ(marker.id, 7 + i);
      EXPECT_LT((marker.T_marker_tag.translation_m - folded.translation_m).norm(), 1e-12);
      EXPECT_LT(marker.T_marker_tag.rotation.angularDistance(folded.rotation), 1e-7);
      folded = folded * half * Pose{bend.rotation, Eigen::Vector3d::Zero()} * half;
    }
    EXPECT_LT(folded.translation_m.norm(), 1e-12);  // it closes
  }
}

TEST(MarkerSheets, ARingsStripsHoldAllFaces) {
  const Family tags("tag36h11");
  const MarkerPrint print = layout_ring(tags.family, {}, Paper::kA4);
  std::map<int, Eigen::Matrix<double, 2, 4>> all;
  int folds = 0;
  for (const PrintPage& page : read_pdf(format_pdf(print.pages, "ring"))) {
    EXPECT_NEAR(page.width_mm, 297.0, kPlace_mm);
    for (const auto& [id, corners_mm] : tags.found_mm(page, 4.0)) all[id] = corners_mm;
    for (const PrintLine& line : page.lines) {
      if (line.style != LineStyle::kDashed) continue;
      ++folds;
      EXPECT_NEAR(length_mm(line), 57.5, kPlace_mm);
    }
  }
  ASSERT_EQ(all.size(), 6u);
  EXPECT_EQ(folds, 6);  // two strips: two folds and a tab each
  for (const int id : {0, 1, 3, 4}) {
    // One face further on the strip is 57.5 mm, the width of a face.
    EXPECT_LT((all[id + 1].row(0) - all[id].row(0)).array().operator-(57.5).abs().maxCoeff(), 2.0 * kDetected_mm);
    EXPECT_LT((all[id + 1].row(1) - all[id].row(1)).cwiseAbs().maxCoeff(), 2.0 * kDetected_mm);
  }
  RingConfig narrow;
  narrow.face_m = 0.05;
  EXPECT_THAT([&] { layout_ring(tags.family, narrow, Paper::kA4); },
              ThrowsMessage<Error>(HasSubstr("does not hold a tag")));
  RingConfig two;
  two.sides = 2;
  EXPECT_THAT([&] { layout_ring(tags.family, two, Paper::kA4); }, ThrowsMessage<Error>(HasSubstr("2 sides")));
}

TEST(MarkerSheets, OpenCvFindsTheCheckerboard) {
  const PrintPage page = read_pdf(format_pdf(std::vector{layout_checkerboard(9, 6, 0.025, Paper::kA4)}, ""))[0];
  const double px_per_mm = 4.0;
  GrayImage image = rasterised(page, px_per_mm);
  const cv::Mat view(image.height, image.width, CV_8UC1, image.pixels.data());
  std::vector<cv::Point2f> corners;
  ASSERT_TRUE(cv::findChessboardCornersSB(view, {9, 6}, corners));
  if (corners.front().x > corners.back().x) std::reverse(corners.begin(), corners.end());
  for (int i = 0; i < 54; ++i) {
    const auto& corner = corners[static_cast<std::size_t>(i)];
    EXPECT_NEAR((corner.x + 0.5) / px_per_mm, 20.0 + 25.0 * (1 + i % 9), 0.05);  // mm: a fifth of a pixel
    EXPECT_NEAR((corner.y + 0.5) / px_per_mm, 8.0 + 25.0 * (1 + i / 9), 0.05);
  }
  EXPECT_THAT([] { layout_checkerboard(9, 6, 0.03, Paper::kA4); }, ThrowsMessage<Error>(HasSubstr("squares of 26 mm")));
}

TEST(MarkerSheets, OpenCvFindsTheCharucoBoard) {
  for (const auto& [columns, rows] : {std::pair{7, 5}, std::pair{5, 6}}) {
    const Family aruco("aruco:DICT_4X4_50");
    const PrintPage page =
        read_pdf(format_pdf(std::vector{layout_charuco(aruco.family, columns, rows, 0.03, 0.022, Paper::kA4)}, ""))[0];
    const double px_per_mm = 4.0;
    GrayImage image = rasterised(page, px_per_mm);
    const cv::Mat view(image.height, image.width, CV_8UC1, image.pixels.data());
    const auto dictionary = cv::aruco::getPredefinedDictionary(cv::aruco::DICT_4X4_50);
    const auto board = cv::aruco::CharucoBoard::create(columns, rows, 0.03F, 0.022F, dictionary);
    std::vector<std::vector<cv::Point2f>> markers;
    std::vector<int> ids;
    cv::aruco::detectMarkers(view, dictionary, markers, ids);
    std::vector<cv::Point2f> corners;
    std::vector<int> corner_ids;
    cv::aruco::interpolateCornersCharuco(markers, ids, view, board, corners, corner_ids);
    ASSERT_EQ(corners.size(), static_cast<std::size_t>((columns - 1) * (rows - 1)));
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const int id = corner_ids[i];
      EXPECT_NEAR((corners[i].x + 0.5) / px_per_mm, 20.0 + 30.0 * (1 + id % (columns - 1)),
                  0.15);  // mm: OpenCV is half a pixel off here
      EXPECT_NEAR((corners[i].y + 0.5) / px_per_mm, 8.0 + 30.0 * (1 + id / (columns - 1)), 0.15);
    }
    EXPECT_THAT([&] { layout_charuco(aruco.family, 5, 5, 0.02, 0.02, Paper::kA4); },
                ThrowsMessage<Error>(HasSubstr("not smaller")));
  }
}

TEST(FormatPdf, TheSameBytesAndSoundOnes) {
  const Family tags("tag36h11");
  const MarkerPrint print = layout_tags(tags.family, {0, 1}, 0.046, Paper::kA4);
  const std::string pdf = format_pdf(print.pages, "a (title) \\ \xc3");
  EXPECT_EQ(pdf, format_pdf(print.pages, "a (title) \\ \xc3"));
  EXPECT_THAT(pdf, HasSubstr("/Title (a \\(title\\) \\\\ ?)"));
  EXPECT_THAT(pdf, HasSubstr("/PrintScaling /None"));
  // The table of objects points to each of them.
  const auto table = std::stoul(pdf.substr(pdf.rfind("startxref") + 10));
  ASSERT_EQ(pdf.substr(table, 4), "xref");
  std::istringstream rows(pdf.substr(table));
  std::string word;
  std::size_t count = 0;
  rows >> word >> word >> count;
  for (std::size_t i = 0; i < count; ++i) {
    std::string offset, generation, kind;
    rows >> offset >> generation >> kind;
    if (i > 0) {
      EXPECT_EQ(pdf.substr(std::stoul(offset), 6), std::to_string(i) + " 0 ob");
    }
  }
  PrintPage bad;
  bad.black.push_back({std::nan(""), 0.0, 1.0, 1.0});
  EXPECT_THROW(format_pdf(std::vector{bad}, ""), Error);
  bad.width_mm = 1.0;
  EXPECT_THROW(format_pdf(std::vector{bad}, ""), Error);
}

TEST(ArucoFamily, TheTrackersDetectorFindsThemInARegion) {
  const Family aruco("aruco:DICT_5X5_100");
  const PrintPage page = layout_tags(aruco.family, {3, 42}, 0.04, Paper::kA4).pages[0];
  const GrayImage image = rasterised(page, 3.0);
  std::vector<TagDetection> tags;
  aruco.detector->detect(image, {image.width / 3, 0, image.width, image.height / 2}, tags);
  ASSERT_EQ(tags.size(), 1u);
  EXPECT_EQ(tags[0].id, 42);
  const auto found = aruco.found_mm(page, 3.0);
  EXPECT_LT(((tags[0].corners_px.array() + 0.5) / 3.0 - found.at(42).array()).abs().maxCoeff(), 0.01);  // mm
  EXPECT_EQ(aruco.detector->pattern(100), std::nullopt);
  EXPECT_THAT([] { make_tag_detector("aruco:DICT_0"); }, ThrowsMessage<Error>(HasSubstr("no dictionary")));
}

}  // namespace
}  // namespace asperity
