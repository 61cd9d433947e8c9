// libasperity_feel.so through its own header, against the C++ renderer that it wraps.

#include <array>
#include <atomic>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include <asperity_feel.h>
#include "asperity/base/random.h"
#include "asperity/render/render_step.h"
#include "asperity/scene/paint.h"
#include "asperity/scene/read_scene.h"
#include "asperity/testkit/count_allocations.h"
#include "asperity/testkit/shape_meshes.h"
#include "asperity/testkit/temp_dir.h"
#include "asperity/texture/texture_file.h"

namespace asperity {
namespace {

// A plane of 40 × 20 mm with a wave of 2 mm along its middle, as a handle and as what the renderer makes of the same.
class CLibrary : public ::testing::Test {
 protected:
  void SetUp() override {
    Fourier1d wave;
    wave.length_mm = 2.0;
    wave.a_m = {50e-6};
    wave.b_m = {0.0};
    Texture texture;
    texture.model = wave;
    texture_file_ = (folder_.path() / "wave.texture.json").string();
    write_texture(texture_file_, texture);

    const TriangleMesh mesh = testkit::plane_mesh({0.04, 0.02}, 20, 10);
    for (const Eigen::Vector3d& v : mesh.vertices_m) vertices_m_.insert(vertices_m_.end(), v.begin(), v.end());
    for (const Triangle& t : mesh.triangles) triangles_.insert(triangles_.end(), t.begin(), t.end());
    SceneObject& object = reference_.objects.emplace_back();
    object.mesh.vertices = mesh.vertices_m;
    object.mesh.triangles = mesh.triangles;
    SceneTexture of_object;
    of_object.texture = read_texture(texture_file_);
    of_object.file = texture_file_;
    const std::array<Eigen::Vector3d, 2> through_m{Eigen::Vector3d(2e-3, 10e-3, 0.0),
                                                   Eigen::Vector3d(38e-3, 10e-3, 0.0)};
    HapticCoordinatesConfig config;
    config.half_width_mm = 3.0;
    paint(object, through_m, of_object, config);

    ASSERT_EQ(make_mesh(&scene_), ASPERITY_OK) << asperity_last_error();
    const std::array<double, 6> points_m{2e-3, 10e-3, 0.0, 38e-3, 10e-3, 0.0};
    ASSERT_EQ(asperity_scene_paint(scene_, 0, texture_file_.c_str(), points_m.data(), 2, 3e-3, 1), ASPERITY_OK)
        << asperity_last_error();
    ASSERT_EQ(asperity_settings_create(&settings_), ASPERITY_OK);
    ASSERT_EQ(asperity_settings_set(settings_, "friction", "0.3"), ASPERITY_OK) << asperity_last_error();
    ASSERT_EQ(asperity_settings_set(settings_, "tip_radius_m", "0.0005"), ASPERITY_OK) << asperity_last_error();
    ASSERT_EQ(asperity_feel_create(scene_, settings_, &feel_), ASPERITY_OK) << asperity_last_error();
  }

  void TearDown() override {
    asperity_feel_free(feel_);
    asperity_settings_free(settings_);
    asperity_scene_free(scene_);
  }

  asperity_status make_mesh(asperity_scene** scene) const {
    return asperity_scene_from_mesh(vertices_m_.data(), vertices_m_.size() / 3, triangles_.data(),
                                    triangles_.size() / 3, scene);
  }

  RenderModel model() const {
    RenderConfig config;
    config.friction = 0.3;
    config.tip_radius_m = 0.0005;
    return make_render_model(reference_, config);
  }

  // Onto the plane and along it, with tremor.
  static std::vector<asperity_motion> stroke(std::size_t count) {
    Random random(8);
    std::vector<asperity_motion> out(count);
    for (std::size_t i = 0; i < count; ++i) {
      asperity_motion& motion = out[i];
      asperity_motion_init(&motion, sizeof motion);
      const double t = static_cast<double>(i) * 1e-3;
      motion.dt_s = 1e-3;
      motion.position_m[0] = 3e-3 + 30e-3 * t;
      motion.position_m[1] = 10e-3 + 1e-4 * std::sin(60.0 * t);
      motion.position_m[2] = 2e-3 * std::exp(-20.0 * t) - 0.7e-3 + 1e-6 * random.normal();
      motion.velocity_mps[0] = 30e-3;
      motion.velocity_mps[2] = -40e-3 * std::exp(-20.0 * t);
    }
    return out;
  }

  testkit::TempDir folder_;
  std::string texture_file_;
  std::vector<double> vertices_m_;
  std::vector<unsigned> triangles_;
  Scene reference_;
  asperity_scene* scene_ = nullptr;
  asperity_settings* settings_ = nullptr;
  asperity_feel* feel_ = nullptr;
};

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

TEST_F(CLibrary, WrongArgumentsAreNamedAndChangeNothing) {
  asperity_scene* scene = scene_;
  EXPECT_EQ(asperity_scene_read("no/such.scene.json", &scene), ASPERITY_BAD_FILE);
  EXPECT_EQ(scene, nullptr);
  EXPECT_NE(std::string(asperity_last_error()).find("no/such.scene.json"), std::string::npos);
  EXPECT_EQ(asperity_scene_read(nullptr, &scene), ASPERITY_BAD_ARGUMENT);
  EXPECT_STREQ(asperity_last_error(), "path is NULL");
  EXPECT_EQ(asperity_scene_read("x", nullptr), ASPERITY_BAD_ARGUMENT);
  const std::array<unsigned, 3> beyond{0, 1, 3};
  EXPECT_EQ(asperity_scene_from_mesh(vertices_m_.data(), 3, beyond.data(), 1, &scene), ASPERITY_BAD_ARGUMENT);
  EXPECT_NE(std::string(asperity_last_error()).find("index 3"), std::string::npos);
  EXPECT_EQ(asperity_scene_from_mesh(vertices_m_.data(), 3, beyond.data(), 0, &scene), ASPERITY_BAD_ARGUMENT);
  const std::array<double, 6> points_m{0.0, 0.0, 0.0, std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0};
  EXPECT_EQ(asperity_scene_paint(scene_, 0, texture_file_.c_str(), points_m.data(), 2, 0.0, 1), ASPERITY_BAD_ARGUMENT);
  EXPECT_EQ(asperity_scene_paint(scene_, 7, texture_file_.c_str(), points_m.data(), 1, 0.0, 1), ASPERITY_BAD_ARGUMENT);
  EXPECT_STREQ(asperity_last_error(), "object 7: the scene has 1");
  EXPECT_EQ(asperity_scene_paint(scene_, 0, "nothing.texture.json", vertices_m_.data(), 2, 0.0, 1), ASPERITY_BAD_FILE);
  EXPECT_EQ(asperity_scene_set_texture(scene_, 77, texture_file_.c_str()), ASPERITY_BAD_ARGUMENT);
  EXPECT_EQ(asperity_scene_set_texture(scene_, 1, "nothing.texture.json"), ASPERITY_BAD_FILE);
  const std::array<double, 6> together_m{0.01, 0.01, 0.0, 0.01, 0.01, 0.0};
  EXPECT_EQ(asperity_scene_paint(scene_, 0, texture_file_.c_str(), together_m.data(), 2, 0.0, 1),
            ASPERITY_BAD_ARGUMENT);
  EXPECT_EQ(
      asperity_scene_from_mesh(vertices_m_.data(), std::numeric_limits<std::size_t>::max(), beyond.data(), 1, &scene),
      ASPERITY_BAD_ARGUMENT);
  EXPECT_EQ(asperity_scene_read("\xFF\xFE.scene.json", &scene), ASPERITY_BAD_FILE);
  EXPECT_EQ(std::string(asperity_last_error()).find('\xFF'), std::string::npos);
  EXPECT_EQ(asperity_scene_set_stiffness(scene_, -5.0), ASPERITY_BAD_ARGUMENT);
  EXPECT_EQ(asperity_scene_set_friction(scene_, std::nan(""), 1.0), ASPERITY_BAD_ARGUMENT);
  const std::array<double, 4> none{};
  EXPECT_EQ(asperity_scene_set_pose(scene_, 0, vertices_m_.data(), none.data()), ASPERITY_BAD_ARGUMENT);
  EXPECT_EQ(asperity_settings_set(settings_, "fiction", "0.3"), ASPERITY_BAD_ARGUMENT);
  EXPECT_NE(std::string(asperity_last_error()).find("friction"), std::string::npos) << asperity_last_error();
  EXPECT_EQ(asperity_settings_set(settings_, "render.friction", "0.3"), ASPERITY_BAD_ARGUMENT);
  EXPECT_NE(std::string(asperity_last_error()).find("'friction'"), std::string::npos) << asperity_last_error();
  EXPECT_EQ(asperity_settings_set(settings_, "wurst", "0.3"), ASPERITY_BAD_ARGUMENT);
  EXPECT_NE(std::string(asperity_last_error()).find("asperity_settings_name()"), std::string::npos);
  EXPECT_EQ(std::string(asperity_last_error()).find("--"), std::string::npos) << asperity_last_error();
  EXPECT_EQ(asperity_settings_set(settings_, "friction", "-1"), ASPERITY_BAD_ARGUMENT);
  EXPECT_EQ(asperity_settings_set(nullptr, "friction", "1"), ASPERITY_BAD_ARGUMENT);
  EXPECT_EQ(asperity_feel_create(nullptr, nullptr, nullptr), ASPERITY_BAD_ARGUMENT);
  EXPECT_EQ(asperity_feel_update(nullptr, scene_, nullptr), ASPERITY_BAD_ARGUMENT);
  EXPECT_EQ(asperity_scene_object_name(scene_, 1), nullptr);
  EXPECT_STREQ(asperity_scene_object_name(scene_, 0), "");
  EXPECT_EQ(asperity_scene_object_count(nullptr), 0u);
  EXPECT_STREQ(asperity_status_text(static_cast<asperity_status>(99)), "unknown status");

  asperity_motion motion = stroke(1).front();
  asperity_touch touch;
  asperity_touch_init(&touch, sizeof touch);
  EXPECT_EQ(asperity_feel_step(feel_, nullptr, &touch), ASPERITY_BAD_ARGUMENT);
  EXPECT_EQ(asperity_feel_step(feel_, &motion, nullptr), ASPERITY_BAD_ARGUMENT);
  EXPECT_EQ(asperity_feel_step(nullptr, &motion, &touch), ASPERITY_BAD_ARGUMENT);
  motion.size = 3;
  EXPECT_EQ(asperity_feel_step(feel_, &motion, &touch), ASPERITY_BAD_ARGUMENT);
  motion.size = sizeof motion;
  motion.position_m[1] = std::nan("");
  EXPECT_EQ(asperity_feel_step(feel_, &motion, &touch), ASPERITY_OK);
  EXPECT_EQ(Eigen::Vector3d::Map(touch.force_N), Eigen::Vector3d::Zero());
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
