#include <gtest/gtest.h>

#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "asperity/recording/tracked_body.h"
#include "asperity/tracking/camera_pose_source.h"
#include "asperity/transport/byte_source.h"
#include "tag_scene.h"

namespace asperity {
namespace {

constexpr std::int64_t kFrame_ns = 20'000'000;

// The probe's two tags and an object's one, of which the calibration tells by the body's name.
std::vector<MarkerPlacement> markers_of_both() {
  std::vector<MarkerPlacement> out = flat_pair();
  MarkerPlacement tag = out.front();
  tag.id = 17;
  tag.body = "object";
  tag.T_marker_tag = {exp_rotation({0.0, 0.2, 0.0}), {0.01, -0.02, 0.005}};
  out.push_back(tag);
  return out;
}

// Both bodies in one picture; either may be out of it.
GrayImage draw_both(const Pose* probe, const Pose* object, std::uint64_t seed) {
  TagScene scene;
  scene.camera = test_camera();
  scene.rays = 3;
  for (MarkerPlacement marker : markers_of_both()) {
    const Pose* body = marker.body.empty() ? probe : object;
    if (body == nullptr) continue;
    marker.T_marker_tag = *body * marker.T_marker_tag;
    scene.body.push_back(marker);
  }
  return draw(scene, Pose{}, seed);
}

class DrawnCamera : public CameraSource {
 public:
  explicit DrawnCamera(std::deque<GrayImage> images) : images_(std::move(images)) {}
  bool read(CameraFrame& frame, std::chrono::milliseconds) override {
    if (images_.empty()) throw LinkLost("drawn: at its end");
    frame.image = std::move(images_.front());
    frame.t_ns = kFrame_ns * ++frames_;
    images_.pop_front();
    return true;
  }
  std::string name() const override { return "drawn"; }

 private:
  std::deque<GrayImage> images_;
  std::int64_t frames_ = 0;
};

Pose shifted(Pose pose, double x_m) {
  pose.translation_m.x() += x_m;
  return pose;
}

TEST(TwoBodies, AreBothFollowedInOneCamera) {
  const Pose probe{exp_rotation({0.15, -0.1, 0.0}), {-0.06, 0.0, 0.36}};
  const Pose object{exp_rotation({-0.1, 0.2, 0.5}), {0.09, 0.02, 0.4}};
  std::deque<GrayImage> images;
  images.push_back(draw_both(&probe, &object, 1));
  const Pose probe_2 = shifted(probe, 0.004), object_2 = shifted(object, -0.003);
  images.push_back(draw_both(&probe_2, &object_2, 2));
  images.push_back(draw_both(&probe_2, nullptr, 3));
  images.push_back(draw_both(nullptr, &object_2, 4));

  const std::vector<MarkerPlacement> markers = markers_of_both();
  TrackConfig config;
  CameraPoseConfig every;
  every.newest = false;
  const auto source = make_camera_pose_source(std::make_unique<DrawnCamera>(std::move(images)),
                                              BodyTracker(test_camera(), markers_of_body(markers, ""), config), every,
                                              {}, make_further_trackers(test_camera(), markers, config));
  std::vector<TrackerSample> samples;
  try {
    for (;;) {
      if (const auto pose = source->read(std::chrono::milliseconds(10))) samples.push_back(pose->sample);
    }
  } catch (const LinkLost&) {
  }
  struct Expected {
    std::size_t body;
    std::int64_t frame;
    Pose pose;
  };
  const std::vector<Expected> expected{{0, 1, probe},    {1, 1, object},  {0, 2, probe_2},
                                       {1, 2, object_2}, {0, 3, probe_2}, {1, 4, object_2}};
  ASSERT_EQ(samples.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(samples[i].body, expected[i].body) << i;
    EXPECT_EQ(samples[i].t_ns, kFrame_ns * expected[i].frame) << i;
    // A single tag of 46 mm at 0.4 m: three standard errors along the ray.
    EXPECT_LT((samples[i].T_world_marker.translation_m - expected[i].pose.translation_m).norm(), 1e-3) << i;
    EXPECT_LT(rotation_between_rad(samples[i].T_world_marker, expected[i].pose), 0.03) << i;
  }
}

}  // namespace
}  // namespace asperity
