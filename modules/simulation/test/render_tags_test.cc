#include "asperity/simulation/render_tags.h"

#include <gmock/gmock.h>

#include <apriltag/apriltag.h>
#include <apriltag/tag36h11.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>

#include "asperity/base/error.h"
#include "asperity/base/random.h"
#include "asperity/recording/camera_model.h"
#include "asperity/simulation/tag_body.h"

namespace asperity {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Key;

constexpr double kDegree = std::numbers::pi / 180.0;

// Even light and background, so that areas can be read off the brightness.
SimulatedCameraConfig plain_camera() {
  SimulatedCameraConfig config;
  config.clutter = false;
  config.vignetting = 0.0;
  config.aperture_m = 0.0;
  return config;
}

Pose pose_at(const Eigen::Vector3d& rotation_rad, const Eigen::Vector3d& p_m) {
  return {exp_rotation(rotation_rad), p_m};
}

Pose random_pose(Random& random) {
  return pose_at({random.uniform(-0.6, 0.6), random.uniform(-0.6, 0.6), random.uniform(-0.3, 0.3)},
                 {random.uniform(-0.06, 0.06), random.uniform(-0.03, 0.03), random.uniform(0.25, 0.6)});
}

// Where the line through tag points `a` and `b` crosses the middle of row `row` (or of column `row`, if `axis` is 1):
// by bisection on its exact projection.
double crossing_px(const CameraCalibration& camera, const Pose& T, Eigen::Vector3d a, Eigen::Vector3d b, int row,
                   int axis) {
  for (int i = 0; i < 60; ++i) {
    const Eigen::Vector3d middle = 0.5 * (a + b);
    const bool before = (*project(camera, T * middle))[1 - axis] < row;
    ((*project(camera, T * a))[1 - axis] < row) == before ? a = middle : b = middle;
  }
  return (*project(camera, T * a))[axis];
}

struct Detection {
  int id = 0;
  std::array<Eigen::Vector2d, 4> corners_px;  // bottom left, bottom right, top right, top left
};

std::map<int, Detection> detect(const GrayImage& image) {
  apriltag_family_t* const family = tag36h11_create();
  apriltag_detector_t* const detector = apriltag_detector_create();
  apriltag_detector_add_family(detector, family);
  detector->quad_decimate = 1.0F;
  std::vector<std::uint8_t> pixels = image.pixels;
  image_u8_t view{image.width, image.height, image.width, pixels.data()};
  zarray_t* const found = apriltag_detector_detect(detector, &view);
  std::map<int, Detection> out;
  for (int i = 0; i < zarray_size(found); ++i) {
    apriltag_detection_t* one = nullptr;
    zarray_get(found, i, &one);
    Detection detection;
    detection.id = one->id;
    // AprilTag's pixel centres are at +0.5.
    for (std::size_t k = 0; k < 4; ++k) detection.corners_px[k] = {one->p[k][0] - 0.5, one->p[k][1] - 0.5};
    out[one->id] = detection;
  }
  apriltag_detections_destroy(found);
  apriltag_detector_destroy(detector);
  tag36h11_destroy(family);
  return out;
}

// The black border's outer edge, between paper and ink, in each row (column) that crosses it near its middle: the ink's
// area in the row says where it lies. Returns the mean and the greatest deviation from the exact projection.
struct EdgeError {
  double sum_px = 0.0;
  double greatest_px = 0.0;
  int count = 0;
};

void measure_edge(const IdealImage& image, const CameraCalibration& camera, const Pose& T, double size_m, int axis,
                  double side, EdgeError& error) {
  const double h = 0.5 * size_m;
  const auto point = [&](double across, double along) {
    return axis == 0 ? Eigen::Vector3d(side * across, along, 0.0) : Eigen::Vector3d(along, side * across, 0.0);
  };
  const double cell = size_m / 8.0;
  const Eigen::Vector3d from = point(h, -2.5 * cell), to = point(h, 2.5 * cell);
  const double first = (*project(camera, T * from))[1 - axis];
  const double last = (*project(camera, T * to))[1 - axis];
  const auto at = [&](int along_row, int row) {
    return axis == 0 ? image.at(along_row, row) : image.at(row, along_row);
  };
  for (int row = static_cast<int>(std::ceil(std::min(first, last))) + 1; row < std::max(first, last) - 1; ++row) {
    const double truth_px = crossing_px(camera, T, from, to, row, axis);
    const double cell_px =
        std::abs(crossing_px(camera, T, point(h - cell, -4 * cell), point(h - cell, 4 * cell), row, axis) - truth_px);
    const int reach = static_cast<int>(0.45 * cell_px);
    const int middle = static_cast<int>(std::lround(truth_px));
    const double at_low = at(middle - reach, row), at_high = at(middle + reach, row);
    double sum = 0.0;
    for (int i = middle - reach; i <= middle + reach; ++i) sum += (at(i, row) - at_high) / (at_low - at_high);
    const double measured_px = middle - reach - 0.5 + sum;
    error.sum_px += measured_px - truth_px;
    error.greatest_px = std::max(error.greatest_px, std::abs(measured_px - truth_px));
    ++error.count;
  }
}

TEST(RenderTags, EdgesLieWhereTheProjectionPutsThem) {
  // Distortion bends an edge by less than 0.003 px within a piece; floats hold coverage to some 1e-6.
  constexpr double kEdgeTol_px = 0.005;
  SimulatedCameraConfig config = plain_camera();
  config.lens_sigma_px = 0.35;  // so that the middle of a cell knows nothing of its neighbours
  const CameraCalibration camera = camera_truth(config);
  const std::vector<MarkerPlacement> body{{7, "tag36h11", 0.046, {}}};
  TagRenderer renderer(config, body);
  Random random(11);
  EdgeError all;
  IdealImage image;
  for (int trial = 0; trial < 40; ++trial) {
    // An upright tag's edges follow rows and columns, where sampling would be worst.
    Pose T = random_pose(random);
    T.translation_m *= 0.45 / 0.6;
    if (trial % 2 == 0) T.rotation = Eigen::Quaterniond::Identity();
    renderer.render_ideal(T, T, image);
    for (const int axis : {0, 1}) {
      for (const double side : {-1.0, 1.0}) measure_edge(image, camera, T, 0.046, axis, side, all);
    }
  }
  EXPECT_GT(all.count, 3000);
  std::printf("edges: mean error %.2g px, greatest %.2g px of %d\n", all.sum_px / all.count, all.greatest_px,
              all.count);
  EXPECT_LT(all.greatest_px, kEdgeTol_px);
}

double total(const IdealImage& image, double background) {
  double sum = 0.0;
  for (const float counts : image.counts) sum += static_cast<double>(counts) - background;
  return sum;
}

Eigen::Vector2d middle_of_mass(const IdealImage& image, double background) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (int row = 0; row < image.height; ++row) {
    for (int column = 0; column < image.width; ++column)
      sum += (image.at(column, row) - background) * Eigen::Vector2d(column, row);
  }
  return sum / total(image, background);
}

TEST(RenderTags, BlurMovesLightButKeepsItsAmount) {
  SimulatedCameraConfig config = plain_camera();
  config.background_counts = 0.0;
  config.distortion = {};
  const Pose T = pose_at(Eigen::Vector3d::Zero(), {0.0, 0.0, 0.3});
  const Pose moved = pose_at(Eigen::Vector3d::Zero(), {0.005, 0.0, 0.3});
  IdealImage sharp, blurred, moving;
  TagRenderer(config, front_tag_body()).render_ideal(T, T, sharp);
  TagRenderer(config, front_tag_body()).render_ideal(T, moved, moving);
  config.lens_sigma_px = 2.5;
  TagRenderer(config, front_tag_body()).render_ideal(T, T, blurred);
  const double area = total(sharp, 0.0);
  EXPECT_NEAR(total(blurred, 0.0) / area, 1.0, 1e-5);
  // A card beside the axis is seen and lit at an angle of 1/120.
  EXPECT_NEAR(total(moving, 0.0) / area, 1.0, 4e-5);
  // 5 mm at 0.3 m move the image by fx/60; its middle by half of it.
  const Eigen::Vector2d shift_px = middle_of_mass(moving, 0.0) - middle_of_mass(sharp, 0.0);
  EXPECT_NEAR(shift_px.x(), 0.5 * config.fx_px / 60.0, 2e-3);
  EXPECT_NEAR(shift_px.y(), 0.0, 2e-3);
  EXPECT_NEAR((middle_of_mass(blurred, 0.0) - middle_of_mass(sharp, 0.0)).norm(), 0.0, 2e-3);
}

TEST(RenderTags, MotionSmearsAnEdgeEvenly) {
  SimulatedCameraConfig config = plain_camera();
  config.distortion = {};
  config.lens_sigma_px = 0.0;
  const Pose open = pose_at(Eigen::Vector3d::Zero(), {0.0, 0.0, 0.3});
  const Pose close = pose_at(Eigen::Vector3d::Zero(), {0.003, 0.0, 0.3});
  TagRenderer renderer(config, {{0, "tag36h11", 0.046, {}}});
  IdealImage image;
  renderer.render_ideal(open, close, image);
  // The left edge goes over 6.4 px: ink's share falls in a straight line; 26 sub-exposures make steps of 1/26.
  const double from_px = config.fx_px * -0.023 / 0.3 + config.cx_px;
  const double to_px = config.fx_px * -0.020 / 0.3 + config.cx_px;
  const int row = static_cast<int>(config.cy_px);
  for (int column = static_cast<int>(from_px) + 1; column < static_cast<int>(to_px) - 1; ++column) {
    const double share = (column - from_px) / (to_px - from_px);
    EXPECT_NEAR(image.at(column, row), config.paper_counts + share * (config.ink_counts - config.paper_counts),
                0.5 * (config.paper_counts - config.ink_counts) / 26);
  }
}

TEST(RenderTags, NoiseHasTheStatedLevel) {
  constexpr int kFrames = 200;
  const SimulatedCameraConfig config;
  const Pose T = pose_at({0.2, 0.1, 0.05}, {0.0, 0.0, 0.3});
  TagRenderer renderer(config, front_tag_body());
  IdealImage ideal;
  renderer.render_ideal(T, T, ideal);
  const std::size_t first = 200 * 640;
  const std::size_t size = 80 * 640;
  std::vector<double> sum(size), sum2(size);
  GrayImage image;
  for (int frame = 0; frame < kFrames; ++frame) {
    renderer.render(T, T, static_cast<std::uint64_t>(frame), image);
    for (std::size_t i = 0; i < size; ++i) {
      sum[i] += image.pixels[first + i];
      sum2[i] += std::pow(image.pixels[first + i], 2);
    }
  }
  double chi2 = 0.0, miss = 0.0;
  for (std::size_t i = 0; i < size; ++i) {
    const double counts = static_cast<double>(ideal.counts[first + i]);
    const double mean = sum[i] / kFrames;
    const double variance = (sum2[i] - kFrames * mean * mean) / (kFrames - 1);
    // Rounding adds 1/12 to the variance; the noise's table knows whole counts.
    const double expected =
        std::pow(config.read_noise_counts, 2) + counts * 255.0 / config.full_well_electrons + 1.0 / 12;
    chi2 += variance / expected / static_cast<double>(size);
    miss += (mean - counts) / static_cast<double>(size);
  }
  EXPECT_NEAR(chi2, 1.0, 0.01);
  EXPECT_NEAR(miss, 0.0, 3.0 * 2.5 / std::sqrt(kFrames * static_cast<double>(size)) + 1e-3);
}

TEST(RenderTags, SameSeedAndFrameGiveTheSameBytes) {
  SimulatedCameraConfig config;
  const Pose T = pose_at({0.2, 0.1, 0.05}, {0.0, 0.0, 0.3});
  const Pose U = pose_at({0.2, 0.1, 0.05}, {0.001, 0.0, 0.3});
  TagRenderer one(config, front_tag_body()), two(config, front_tag_body());
  GrayImage a, b;
  one.render(U, T, 3, a);
  one.render(T, U, 5, a);
  two.render(T, U, 5, b);
  EXPECT_EQ(a.pixels, b.pixels);
  two.render(T, U, 6, b);
  EXPECT_NE(a.pixels, b.pixels);
  config.seed = 2;
  TagRenderer(config, front_tag_body()).render(T, U, 5, b);
  EXPECT_NE(a.pixels, b.pixels);
}

TEST(RenderTags, AprilTagReadsThemInTheStatedFrame) {
  const SimulatedCameraConfig config;
  const CameraCalibration camera = camera_truth(config);
  const auto body = front_tag_body();
  TagRenderer renderer(config, body);
  Random random(5);
  GrayImage image;
  double sum2 = 0.0;
  int corners = 0;
  for (int trial = 0; trial < 8; ++trial) {
    const Pose T = random_pose(random);
    renderer.render(T, T, static_cast<std::uint64_t>(trial), image);
    const std::map<int, Detection> found = detect(image);
    for (const MarkerPlacement& tag : body) {
      ASSERT_THAT(found, Contains(Key(tag.id)));
      const double h = 0.5 * tag.size_m;
      const std::array<Eigen::Vector3d, 4> corners_m{{{-h, h, 0}, {h, h, 0}, {h, -h, 0}, {-h, -h, 0}}};
      for (std::size_t i = 0; i < 4; ++i) {
        const Eigen::Vector2d truth_px = *project(camera, T * (tag.T_marker_tag * corners_m[i]));
        const double miss_px = (found.at(tag.id).corners_px[i] - truth_px).norm();
        EXPECT_LT(miss_px, 1.0) << "trial " << trial << " tag " << tag.id << " corner " << i;
        sum2 += miss_px * miss_px;
        ++corners;
      }
    }
  }
  std::printf("libapriltag's corners: %.3f px rms\n", std::sqrt(sum2 / corners));
  EXPECT_LT(std::sqrt(sum2 / corners), 0.25);  // its line fits; edges themselves are tested above
}

TEST(RenderTags, ARingIsSeenFromAllSides) {
  const SimulatedCameraConfig config;
  const auto body = ring_tag_body();
  TagRenderer renderer(config, body);
  GrayImage image;
  for (int side = 0; side < 6; ++side) {
    // Turning the body by +60° brings the next face to the front.
    const Pose T = pose_at({0.0, -60.0 * side * kDegree, 0.0}, {0.0, 0.0, 0.3});
    renderer.render(T, T, 0, image);
    EXPECT_THAT(detect(image), Contains(Key(side)));
    const Pose between = pose_at({0.0, -60.0 * (side + 0.5) * kDegree, 0.0}, {0.0, 0.0, 0.3});
    renderer.render(between, between, 0, image);
    EXPECT_THAT(detect(image), Contains(Key(side)));
    EXPECT_THAT(detect(image), Contains(Key((side + 1) % 6)));
  }
}

TEST(RenderTags, WhatIsNotInFrontIsNotDrawn) {
  const SimulatedCameraConfig config;
  TagRenderer renderer(config, front_tag_body());
  IdealImage empty, image;
  const Pose away = pose_at({0.0, std::numbers::pi, 0.0}, {0.0, 0.0, 0.3});
  renderer.render_ideal(away, away, empty);
  for (const Pose& T :
       {pose_at({0, 0, 0}, {0, 0, -0.3}), pose_at({0, 0, 0}, {9.0, 0, 0.3}), pose_at({0, 0, 0}, {0, 0, 0.01})}) {
    renderer.render_ideal(T, T, image);
    EXPECT_EQ(image.counts, empty.counts);
  }
  // Half outside of the image is drawn.
  const Pose half = pose_at({0, 0, 0}, {-0.15, 0, 0.3});
  renderer.render_ideal(half, half, image);
  EXPECT_NE(image.counts, empty.counts);
}

TEST(RenderTags, RefusesWhatItCannotDraw) {
  const SimulatedCameraConfig config;
  const auto refusal = [&](const MarkerPlacement& tag) {
    try {
      TagRenderer renderer(config, {tag});
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(refusal({587, "tag36h11", 0.03, {}}), HasSubstr("no tag 587"));
  EXPECT_THAT(refusal({0, "tag\x1b", 0.03, {}}), HasSubstr("tag\\x1b"));
  EXPECT_THAT(refusal({0, "tag36h11", 0.0, {}}), HasSubstr("size"));
  SimulatedCameraConfig slow;
  slow.exposure_s = 0.02;
  EXPECT_THROW(TagRenderer(slow, front_tag_body()), Error);
}

}  // namespace
}  // namespace asperity
