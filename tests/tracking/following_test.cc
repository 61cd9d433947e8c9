#include <gtest/gtest.h>

#include <cstdint>
#include <optional>
#include <vector>

#include "asperity/recording/camera_model.h"
#include "asperity/tracking/detect_tags.h"
#include "asperity/tracking/track_body.h"
#include "tag_scene.h"

namespace asperity {
namespace {

constexpr std::int64_t kStep_ns = 10'000'000;

TagScene one_tag() {
  TagScene scene;
  scene.camera = test_camera();
  scene.body = {flat_pair().front()};
  scene.rays = 3;
  return scene;
}

TEST(Following, ASingleTagThatLeapsIsNotBelievedUntilThePredictionHasLapsed) {
  const TagScene scene = one_tag();
  BodyTracker tracker(scene.camera, scene.body);
  const Pose here = random_view(0.35, 0.3, 3);
  Pose there = here;
  there.translation_m.x() += here.translation_m.x() > 0.0 ? -0.1 : 0.1;  // 10 m/s
  EXPECT_TRUE(tracker.push(draw(scene, here, 1), 0));
  EXPECT_TRUE(tracker.push(draw(scene, here, 2), kStep_ns));
  EXPECT_FALSE(tracker.push(draw(scene, there, 3), 2 * kStep_ns));
  // Back where it was, it is seen at once; 0.1 m in 0.11 s is no leap.
  EXPECT_TRUE(tracker.push(draw(scene, here, 4), 3 * kStep_ns));
  const auto found = tracker.push(draw(scene, there, 5), 14 * kStep_ns);
  ASSERT_TRUE(found);
  EXPECT_LT((found->sample.T_world_marker.translation_m - there.translation_m).norm(), 5e-4);
}

TEST(Following, ABodyThatWasAwayIsFoundAgain) {
  const TagScene scene = one_tag();
  BodyTracker tracker(scene.camera, scene.body);
  TagScene empty = scene;
  empty.body.clear();
  EXPECT_TRUE(tracker.push(draw(scene, random_view(0.35, 0.3, 3), 1), 0));
  for (int i = 1; i <= 12; ++i) {
    EXPECT_FALSE(tracker.push(draw(empty, random_view(0.35, 0.3, 3), static_cast<std::uint64_t>(i)), i * kStep_ns));
  }
  const Pose again = random_view(0.45, 0.3, 8);
  const auto found = tracker.push(draw(scene, again, 20), 100 * kStep_ns);
  ASSERT_TRUE(found);
  EXPECT_LT((found->sample.T_world_marker.translation_m - again.translation_m).norm(), 5e-4);
}

// A finger over a corner hides the tag from the detector; its picture still counts.
TEST(Following, ATagWhoseCornerIsCoveredIsFoundByItsPicture) {
  TagScene scene;
  scene.camera = test_camera();
  scene.body = flat_pair();
  scene.rays = 3;
  const Pose pose = random_view(0.35, 0.3, 5);
  const Eigen::Vector2d corner = *project(scene.camera, pose * tag_corners_m(scene.body[0]).col(0));
  const GrayImage image = draw(scene, pose, 9, {{corner, 16.0, 110.0}});
  std::vector<TagDetection> detected;
  make_tag_detector("tag36h11")->detect(image, whole(image), detected);
  ASSERT_EQ(detected.size(), 1u) << "the case is not the one meant";
  for (const bool find_covered : {false, true}) {
    TrackConfig config;
    config.find_covered = find_covered;
    BodyTracker tracker(scene.camera, scene.body, config);
    const auto found = tracker.push(image, 0);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->sample.markers, find_covered ? 2 : 1);
    if (!find_covered) continue;
    EXPECT_LT((found->sample.T_world_marker.translation_m - pose.translation_m).norm(), 1e-4);
  }
}

// 35 grey levels amid clutter of all of them: the detector's threshold lies outside of the tag's own levels.
TEST(Following, AFaintTagIsFoundInItsBandOfGrey) {
  TagScene scene = one_tag();
  scene.black = 80.0;
  scene.white = 115.0;
  int with = 0, without = 0;
  constexpr int kImages = 6;
  for (int i = 0; i < kImages; ++i) {
    const GrayImage image =
        draw(scene, random_view(0.35, 0.4, static_cast<std::uint64_t>(60 + i)), 70U + static_cast<std::uint64_t>(i));
    TrackConfig config;
    with += BodyTracker(scene.camera, scene.body, config).push(image, 0) ? 1 : 0;
    config.find_faint = false;
    without += BodyTracker(scene.camera, scene.body, config).push(image, 0) ? 1 : 0;
  }
  EXPECT_EQ(with, kImages) << without << " without";
}

}  // namespace
}  // namespace asperity
