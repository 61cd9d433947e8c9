// libasperity_feel.so through its own header, against the C++ renderer that it wraps.

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstring>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include <asperity_feel.h>
#include "asperity/render/render_step.h"
#include "asperity/testkit/count_allocations.h"
#include "c_library_fixture.h"

namespace asperity {
namespace {

using CLibrary = testkit::CLibraryTest;

TEST_F(CLibrary, FeelsWhatTheRendererFeels) {
  const std::vector<asperity_motion> motions = stroke(900);
  std::vector<asperity_touch> touches(motions.size());
  for (asperity_touch& touch : touches) asperity_touch_init(&touch, sizeof touch);
  ASSERT_EQ(asperity_feel_steps(feel_, motions.data(), touches.data(), touches.size()), ASPERITY_OK);
  const RenderModel expected = model();
  ServoState state;
  std::size_t touching = 0;
  double highest_m = 0.0, vibration_N = 0.0;
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const DeviceState device{Eigen::Vector3d::Map(motions[i].position_m), Eigen::Vector3d::Map(motions[i].velocity_mps),
                             motions[i].dt_s};
    const ServoOutput out = render_step(expected, state, device);
    const asperity_touch& touch = touches[i];
    EXPECT_EQ(Eigen::Vector3d::Map(touch.force_N), out.force_N) << i;
    EXPECT_EQ(Eigen::Vector3d::Map(touch.contact_N), out.contact_N) << i;
    EXPECT_EQ(Eigen::Vector3d::Map(touch.texture_N), out.texture_N) << i;
    EXPECT_EQ(Eigen::Vector3d::Map(touch.friction_N), out.friction_N) << i;
    EXPECT_EQ(Eigen::Vector3d::Map(touch.proxy_m), out.proxy_m) << i;
    EXPECT_EQ(Eigen::Vector3d::Map(touch.point_m), out.contact.p_world_m) << i;
    EXPECT_EQ(touch.triangle, out.contact.triangle) << i;
    EXPECT_EQ(touch.touching, out.contact.found() ? 1 : 0) << i;
    EXPECT_EQ(touch.sticking, out.sticking ? 1 : 0) << i;
    touching += out.contact.found();
    highest_m = std::max(highest_m, touch.texture_height_m);
    vibration_N = std::max(vibration_N, std::abs(touch.vibration_N));
  }
  EXPECT_GT(touching, 700u);
  EXPECT_GT(highest_m, 40e-6);  // the wave's own height is 50 µm
  EXPECT_GT(vibration_N, 0.01);
}

TEST_F(CLibrary, OneAtATimeIsAllAtOnceAndAgainAfterReset) {
  const std::vector<asperity_motion> motions = stroke(300);
  std::vector<asperity_touch> all(motions.size());
  for (asperity_touch& touch : all) asperity_touch_init(&touch, sizeof touch);
  ASSERT_EQ(asperity_feel_steps(feel_, motions.data(), all.data(), all.size()), ASPERITY_OK);
  asperity_feel_reset(feel_);
  for (std::size_t i = 0; i < motions.size(); ++i) {
    asperity_touch touch;
    asperity_touch_init(&touch, sizeof touch);
    ASSERT_EQ(asperity_feel_step(feel_, &motions[i], &touch), ASPERITY_OK);
    EXPECT_EQ(std::memcmp(&touch, &all[i], sizeof touch), 0) << i;
  }
}

TEST_F(CLibrary, AStepAllocatesNothing) {
  const std::vector<asperity_motion> motions = stroke(500);
  std::vector<asperity_touch> touches(motions.size());
  for (asperity_touch& touch : touches) asperity_touch_init(&touch, sizeof touch);
  const std::size_t before = testkit::count_allocations();
  asperity_feel_steps(feel_, motions.data(), touches.data(), touches.size());
  asperity_feel_reset(feel_);
  EXPECT_EQ(testkit::count_allocations(), before);
  asperity_scene* other = nullptr;  // the count does see the library's
  ASSERT_EQ(make_mesh(&other), ASPERITY_OK);
  asperity_scene_free(other);
  EXPECT_GT(testkit::count_allocations(), before);
}

// The stiffness goes from 500 to 790 N/m and back in steps of 290 under a tip 0.7 mm deep: 0.2 N at once, were it not
// eased over the cross-fade of 50 ms.
TEST_F(CLibrary, MaterialsAndTexturesFadeWhenUpdatedWhileStepping) {
  asperity_motion motion = stroke(1).front();
  motion.velocity_mps[0] = motion.velocity_mps[2] = 0.0;
  std::atomic<bool> stop{false};
  std::atomic<std::size_t> steps{0};
  double largest_N = 0.0, last_N = 0.0;
  std::thread servo([&] {
    asperity_touch touch;
    asperity_touch_init(&touch, sizeof touch);
    for (; !stop; ++steps) {
      motion.position_m[2] = std::max(-0.7e-3, 1e-3 - 1e-6 * static_cast<double>(steps));  // down, then still
      asperity_feel_step(feel_, &motion, &touch);
      EXPECT_TRUE(std::isfinite(touch.force_N[2]));
      largest_N = std::max(largest_N, std::abs(touch.force_N[2] - last_N));
      last_N = touch.force_N[2];
    }
  });
  for (int i = 0; i < 30; ++i) {
    EXPECT_EQ(asperity_scene_set_stiffness(scene_, i % 2 == 0 ? 500.0 : 790.0), ASPERITY_OK);
    EXPECT_EQ(asperity_scene_set_texture(scene_, 1, texture_file_.c_str()), ASPERITY_OK) << asperity_last_error();
    EXPECT_EQ(asperity_feel_update(feel_, scene_, settings_), ASPERITY_OK) << asperity_last_error();
    const std::size_t until = steps + 300;
    while (steps < until) std::this_thread::yield();
  }
  stop = true;
  servo.join();
  EXPECT_GT(last_N, 0.2);
  EXPECT_LT(largest_N, 0.05);
}

TEST_F(CLibrary, PosesMoveObjectsAndMaterialsCount) {
  asperity_scene* flat = nullptr;
  ASSERT_EQ(make_mesh(&flat), ASPERITY_OK);
  const std::array<double, 3> up_m{0.0, 0.0, 5e-3};
  const std::array<double, 4> twice{2.0, 0.0, 0.0, 0.0};
  EXPECT_EQ(asperity_scene_set_pose(flat, 0, up_m.data(), twice.data()), ASPERITY_OK) << asperity_last_error();
  EXPECT_EQ(asperity_scene_set_stiffness(flat, 800.0), ASPERITY_OK);
  EXPECT_EQ(asperity_scene_set_friction(flat, 0.0, 1.0), ASPERITY_OK);
  asperity_feel* feel = nullptr;
  ASSERT_EQ(asperity_feel_create(flat, nullptr, &feel), ASPERITY_OK) << asperity_last_error();
  asperity_motion motion = stroke(1).front();
  asperity_touch touch;
  asperity_touch_init(&touch, sizeof touch);
  for (const double z_m : {6e-3, 4e-3}) {
    motion.position_m[2] = z_m;
    ASSERT_EQ(asperity_feel_step(feel, &motion, &touch), ASPERITY_OK);
  }
  EXPECT_NEAR(touch.force_N[2], 0.8, 1e-9);  // 800 N/m by 1 mm
  EXPECT_NEAR(touch.normal[2], 1.0, 1e-12);
  EXPECT_NEAR(touch.point_m[2], 5e-3, 1e-12);
  asperity_feel_free(feel);
  asperity_scene_free(flat);
}

TEST_F(CLibrary, MeshesAndPosesAreGivenBack) {
  asperity_scene* flat = nullptr;
  ASSERT_EQ(make_mesh(&flat), ASPERITY_OK);
  std::size_t vertices = 0, triangles = 0;
  ASSERT_EQ(asperity_scene_mesh(flat, 0, nullptr, 0, &vertices, nullptr, 0, &triangles), ASPERITY_OK);
  ASSERT_EQ(3 * vertices, vertices_m_.size());
  std::vector<double> at_m(3 * vertices + 1, -7.0);
  std::vector<unsigned> corners(3 * triangles, 99);
  ASSERT_EQ(asperity_scene_mesh(flat, 0, at_m.data(), vertices, &vertices, corners.data(), triangles, &triangles),
            ASPERITY_OK);
  EXPECT_TRUE(std::equal(vertices_m_.begin(), vertices_m_.end(), at_m.begin()));
  EXPECT_EQ(at_m.back(), -7.0);
  EXPECT_LT(*std::max_element(corners.begin(), corners.end()), vertices);
  // No more is written than there is room for.
  at_m.assign(at_m.size(), -7.0);
  ASSERT_EQ(asperity_scene_mesh(flat, 0, at_m.data(), 1, &vertices, nullptr, 0, &triangles), ASPERITY_OK);
  EXPECT_EQ(at_m[3], -7.0);
  EXPECT_EQ(asperity_scene_mesh(flat, 1, nullptr, 0, &vertices, nullptr, 0, &triangles), ASPERITY_BAD_ARGUMENT);
  EXPECT_EQ(asperity_scene_mesh(flat, 0, nullptr, 0, nullptr, nullptr, 0, &triangles), ASPERITY_BAD_ARGUMENT);

  const std::array<double, 3> to_m{0.01, -0.02, 0.03};
  const std::array<double, 4> turned{0.0, 0.0, 0.0, 2.0};
  ASSERT_EQ(asperity_scene_set_pose(flat, 0, to_m.data(), turned.data()), ASPERITY_OK);
  std::array<double, 3> position_m{};
  std::array<double, 4> rotation{};
  ASSERT_EQ(asperity_scene_pose(flat, 0, position_m.data(), rotation.data()), ASPERITY_OK);
  EXPECT_EQ(position_m, to_m);
  EXPECT_EQ(rotation, (std::array<double, 4>{0.0, 0.0, 0.0, 1.0}));
  EXPECT_EQ(asperity_scene_pose(flat, 1, position_m.data(), rotation.data()), ASPERITY_BAD_ARGUMENT);
  EXPECT_EQ(asperity_scene_pose(flat, 0, nullptr, rotation.data()), ASPERITY_BAD_ARGUMENT);
  asperity_scene_free(flat);
}

// A program of a later 1.x: longer structures, of which this library knows the beginning.
TEST_F(CLibrary, LongerStructuresOfALaterVersionAreServed) {
  struct LaterMotion {
    asperity_motion known;
    double added = 7.0;
  };
  struct LaterTouch {
    asperity_touch known;
    double added = 7.0;
  };
  std::vector<asperity_motion> motions = stroke(60);
  std::vector<LaterMotion> later(motions.size());
  std::vector<asperity_touch> touches(motions.size());
  std::vector<LaterTouch> later_touches(motions.size());
  for (std::size_t i = 0; i < motions.size(); ++i) {
    asperity_touch_init(&touches[i], sizeof touches[i]);
    later[i].known = motions[i];
    later[i].known.size = sizeof(LaterMotion);
    asperity_touch_init(&later_touches[i].known, sizeof(asperity_touch));
    later_touches[i].known.size = sizeof(LaterTouch);
  }
  ASSERT_EQ(asperity_feel_steps(feel_, motions.data(), touches.data(), touches.size()), ASPERITY_OK);
  asperity_feel_reset(feel_);
  ASSERT_EQ(asperity_feel_steps(feel_, &later[0].known, &later_touches[0].known, later.size()), ASPERITY_OK);
  for (std::size_t i = 0; i < touches.size(); ++i) {
    EXPECT_EQ(Eigen::Vector3d::Map(touches[i].force_N), Eigen::Vector3d::Map(later_touches[i].known.force_N));
    EXPECT_EQ(later_touches[i].known.size, sizeof(LaterTouch));
    EXPECT_EQ(later_touches[i].added, 7.0);
  }
}

TEST_F(CLibrary, SettingsAreListed) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < asperity_settings_count(); ++i) {
    names.emplace_back(asperity_settings_name(i));
    EXPECT_GT(std::strlen(asperity_settings_help(i)), 5u) << names.back();
  }
  for (const char* name : {"tip_radius_m", "friction", "texture.model", "rate_Hz"})
    EXPECT_NE(std::find(names.begin(), names.end(), name), names.end()) << name;
  EXPECT_EQ(asperity_settings_name(names.size()), nullptr);
  EXPECT_EQ(asperity_settings_set(settings_, "texture.model", "height"), ASPERITY_OK) << asperity_last_error();
  EXPECT_EQ(asperity_settings_set(settings_, "rate_Hz", "2000"), ASPERITY_OK) << asperity_last_error();
}

// What a program was compiled with must stay where it is: x86-64's and AArch64's layout of version 1.0.
TEST(CLibraryLayout, OfVersionOneStays) {
  static_assert(sizeof(asperity_motion) == 64 && offsetof(asperity_motion, dt_s) == 56);
  static_assert(offsetof(asperity_touch, force_N) == 8 && offsetof(asperity_touch, proxy_m) == 104);
  static_assert(offsetof(asperity_touch, vibration_N) == 136 && offsetof(asperity_touch, object) == 216);
  static_assert(offsetof(asperity_touch, starts_inside) == 232 && sizeof(asperity_touch) == 240);
  EXPECT_EQ(std::string(asperity_feel_version()).substr(0, 4), "1.2 ");
}

}  // namespace
}  // namespace asperity
