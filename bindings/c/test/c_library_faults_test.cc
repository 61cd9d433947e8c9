// What libasperity_feel.so does with arguments and files that are wrong.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <asperity_feel.h>
#include "c_library_fixture.h"

namespace asperity {
namespace {

using CLibrary = testkit::CLibraryTest;

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

// Each function with something to write fails, once for each of its arguments that can be wrong: counts are 0 after it,
// handles NULL, and arrays and structures have what the caller had put there.
TEST_F(CLibrary, AFailedCallWritesNothing) {
  constexpr double kKept = -7.0;
  std::array<double, 4> numbers{kKept, kKept, kKept, kKept};
  std::array<double, 4> more_numbers = numbers;
  std::array<unsigned, 3> corners{99, 99, 99};
  const auto is_kept = [&] {
    const auto kept = [](double x) { return x == kKept; };
    return std::all_of(numbers.begin(), numbers.end(), kept) &&
           std::all_of(more_numbers.begin(), more_numbers.end(), kept) && corners == std::array{99U, 99U, 99U};
  };
  for (const std::size_t object : {std::size_t{0}, std::size_t{1}}) {  // of 0 a pointer is missing, 1 there is not
    for (const bool of_vertices : {true, false}) {
      std::size_t count = 5;
      EXPECT_EQ(asperity_scene_mesh(scene_, object, numbers.data(), 1, of_vertices ? &count : nullptr, corners.data(),
                                    1, of_vertices ? nullptr : &count),
                ASPERITY_BAD_ARGUMENT);
      EXPECT_EQ(count, 0u) << of_vertices;
      EXPECT_TRUE(is_kept());
    }
  }
  std::size_t vertices = 5, triangles = 5;
  EXPECT_EQ(asperity_scene_mesh(nullptr, 0, numbers.data(), 1, &vertices, corners.data(), 1, &triangles),
            ASPERITY_BAD_ARGUMENT);
  EXPECT_EQ(vertices + triangles, 0u);
  EXPECT_EQ(asperity_scene_pose(scene_, 0, numbers.data(), nullptr), ASPERITY_BAD_ARGUMENT);
  EXPECT_EQ(asperity_scene_pose(scene_, 0, nullptr, more_numbers.data()), ASPERITY_BAD_ARGUMENT);
  EXPECT_EQ(asperity_scene_pose(scene_, 1, numbers.data(), more_numbers.data()), ASPERITY_BAD_ARGUMENT);
  EXPECT_TRUE(is_kept());

  std::vector<float> samples(4, -7.0F);
  std::size_t written = 5;
  for (const auto& [force_N, rate_Hz, volume] :
       {std::tuple{numbers.data(), 1.0, 1.0}, {numbers.data(), 1000.0, 2.0}, {nullptr, 1000.0, 1.0}}) {
    written = 5;
    EXPECT_EQ(asperity_vibration_samples(force_N, 4, rate_Hz, 48000.0, volume, 1.0, samples.data(), 4, &written),
              ASPERITY_BAD_ARGUMENT);
    EXPECT_EQ(written, 0u);
  }
  EXPECT_EQ(asperity_vibration_samples(numbers.data(), 4, 1000.0, 48000.0, 1.0, 1.0, samples.data(), 4, nullptr),
            ASPERITY_BAD_ARGUMENT);
  EXPECT_EQ(samples, std::vector<float>(4, -7.0F));

  asperity_scene* scene = scene_;
  EXPECT_EQ(asperity_scene_from_mesh(nullptr, 3, corners.data(), 1, &scene), ASPERITY_BAD_ARGUMENT);
  EXPECT_EQ(scene, nullptr);
  asperity_feel* feel = feel_;
  EXPECT_EQ(asperity_feel_create(nullptr, settings_, &feel), ASPERITY_BAD_ARGUMENT);
  EXPECT_EQ(feel, nullptr);
  EXPECT_EQ(asperity_settings_create(nullptr), ASPERITY_BAD_ARGUMENT);
  asperity_rumble* kept_rumble = nullptr;
  ASSERT_EQ(asperity_rumble_create(1000.0, 1.0, &kept_rumble), ASPERITY_OK);
  asperity_rumble* rumble = kept_rumble;
  EXPECT_EQ(asperity_rumble_create(std::nan(""), 1.0, &rumble), ASPERITY_BAD_ARGUMENT);
  EXPECT_EQ(rumble, nullptr);
  asperity_rumble_free(kept_rumble);

  // Structures: of the second step nothing is done if the first cannot be.
  std::vector<asperity_motion> motions = stroke(2);
  std::array<asperity_touch, 2> touches;
  for (asperity_touch& touch : touches) {
    std::memset(&touch, 0x5A, sizeof touch);
    touch.size = sizeof touch;
  }
  const std::array<asperity_touch, 2> before = touches;
  motions[0].size = 1;
  EXPECT_EQ(asperity_feel_steps(feel_, motions.data(), touches.data(), 2), ASPERITY_BAD_ARGUMENT);
  EXPECT_EQ(asperity_feel_steps(nullptr, motions.data(), touches.data(), 2), ASPERITY_BAD_ARGUMENT);
  EXPECT_EQ(asperity_feel_steps(feel_, nullptr, touches.data(), 2), ASPERITY_BAD_ARGUMENT);
  EXPECT_EQ(std::memcmp(touches.data(), before.data(), sizeof before), 0);
}

// What a setter refuses leaves the scene as it was: pose, material and texture, one after the other.
TEST_F(CLibrary, ARefusedChangeChangesNothing) {
  const auto force_N = [&] {
    asperity_feel* feel = nullptr;
    EXPECT_EQ(asperity_feel_create(scene_, settings_, &feel), ASPERITY_OK);
    const std::vector<asperity_motion> motions = stroke(200);
    std::vector<asperity_touch> touches(motions.size());
    for (asperity_touch& touch : touches) asperity_touch_init(&touch, sizeof touch);
    EXPECT_EQ(asperity_feel_steps(feel, motions.data(), touches.data(), touches.size()), ASPERITY_OK);
    asperity_feel_free(feel);
    return std::array<double, 2>{touches.back().force_N[0], touches.back().force_N[2]};
  };
  const std::array<double, 2> before_N = force_N();
  const double nan = std::nan("");
  const std::array<double, 3> at_m{0.0, 0.0, 0.02}, bad_m{0.0, nan, 0.0};
  const std::array<double, 4> turned{0.0, 0.0, 0.0, 1.0}, bad{0.0, nan, 0.0, 1.0};
  const std::array<double, 6> points_m{2e-3, 10e-3, 0.0, 38e-3, 10e-3, 0.0};
  EXPECT_EQ(asperity_scene_set_pose(scene_, 0, at_m.data(), bad.data()), ASPERITY_BAD_ARGUMENT);
  EXPECT_EQ(asperity_scene_set_pose(scene_, 0, bad_m.data(), turned.data()), ASPERITY_BAD_ARGUMENT);
  EXPECT_EQ(asperity_scene_set_pose(scene_, 0, nullptr, turned.data()), ASPERITY_BAD_ARGUMENT);
  EXPECT_EQ(asperity_scene_set_friction(scene_, 5.0, 0.5), ASPERITY_BAD_ARGUMENT);
  EXPECT_EQ(asperity_scene_set_friction(scene_, -1.0, 2.0), ASPERITY_BAD_ARGUMENT);
  EXPECT_EQ(asperity_scene_set_stiffness(scene_, nan), ASPERITY_BAD_ARGUMENT);
  EXPECT_EQ(asperity_scene_paint(scene_, 0, texture_file_.c_str(), points_m.data(), 2, -1.0, 1), ASPERITY_BAD_ARGUMENT);
  EXPECT_EQ(asperity_scene_paint(scene_, 0, texture_file_.c_str(), points_m.data(), 2, 0.0, -1), ASPERITY_BAD_ARGUMENT);
  EXPECT_EQ(asperity_scene_paint(scene_, 0, "nothing.texture.json", points_m.data(), 2, 0.0, 1), ASPERITY_BAD_FILE);
  EXPECT_EQ(asperity_scene_set_texture(scene_, 1, nullptr), ASPERITY_BAD_ARGUMENT);
  EXPECT_EQ(asperity_settings_set(settings_, "friction", "nan"), ASPERITY_BAD_ARGUMENT);
  EXPECT_EQ(asperity_settings_set(settings_, "friction", nullptr), ASPERITY_BAD_ARGUMENT);
  EXPECT_EQ(force_N(), before_N);
}

// A plate of 60 by 20 in millimetres, read as metres; its longest edge is 60 mm if that is stated.
TEST_F(CLibrary, AnImplausibleUnitIsAskedFor) {
  const auto read = [&](const std::string& file, std::optional<double> unit_m) {
    asperity_scene* scene = nullptr;
    const asperity_status status = unit_m ? asperity_scene_read_with_unit(file.c_str(), *unit_m, &scene)
                                          : asperity_scene_read(file.c_str(), &scene);
    EXPECT_EQ(scene != nullptr, status == ASPERITY_OK);
    std::array<double, 9> vertices_m{};
    std::size_t vertices = 0, triangles = 0;
    if (scene != nullptr) {
      EXPECT_EQ(asperity_scene_mesh(scene, 0, vertices_m.data(), 3, &vertices, nullptr, 0, &triangles), ASPERITY_OK);
    }
    asperity_scene_free(scene);
    return std::pair(status, vertices_m[3]);
  };
  const std::string in_mm = (folder_.path() / "plate.obj").string();
  std::ofstream(in_mm) << "v 0 0 0\nv 60 0 0\nv 0 20 0\nf 1 2 3\n";
  EXPECT_EQ(read(in_mm, std::nullopt).first, ASPERITY_BAD_FILE);
  EXPECT_EQ(std::string(asperity_last_error()),
            in_mm +
                ": the mesh is 63.2 m large if its unit is a metre; state its unit: "
                "asperity_scene_read_with_unit()");
  EXPECT_EQ(read(in_mm, 1e-3), std::pair(ASPERITY_OK, 60e-3));
  EXPECT_EQ(read(in_mm, 1.0), std::pair(ASPERITY_OK, 60.0));
  const std::string tiny = (folder_.path() / "tiny.obj").string();
  std::ofstream(tiny) << "v 0 0 0\nv 6e-4 0 0\nv 0 2e-4 0\nf 1 2 3\n";
  EXPECT_EQ(read(tiny, std::nullopt).first, ASPERITY_BAD_FILE);
  for (const double unit_m : {0.0, -1.0, 1e-300, 1e300, std::nan("")}) {
    EXPECT_EQ(read(in_mm, unit_m).first, ASPERITY_BAD_ARGUMENT) << unit_m;
    EXPECT_EQ(std::string(asperity_last_error()).substr(0, 10), "unit_m is ") << asperity_last_error();
  }
  EXPECT_EQ(asperity_scene_read_with_unit(in_mm.c_str(), 1.0, nullptr), ASPERITY_BAD_ARGUMENT);
  asperity_scene* none = scene_;
  EXPECT_EQ(asperity_scene_read_with_unit(nullptr, 1.0, &none), ASPERITY_BAD_ARGUMENT);
  EXPECT_EQ(none, nullptr);
}

// Places and meshes that come of no object, and velocities and positions that a hand never has: named, or without an
// effect on the steps that follow.
TEST_F(CLibrary, NumbersThatAreNotPlausibleAreRefusedOrForgotten) {
  const std::array<unsigned, 3> corners{0, 1, 2};
  for (const auto& [side_m, text] :
       {std::pair(1e300, "vertices_m: point 1 is beyond 1e+06 m"),
        std::pair(1e-300, "vertices_m: a mesh of 0 m is not plausible: at least 1e-09 m")}) {
    const std::array<double, 9> vertices_m{0.0, 0.0, 0.0, side_m, 0.0, 0.0, 0.0, side_m, 0.0};
    asperity_scene* scene = scene_;
    EXPECT_EQ(asperity_scene_from_mesh(vertices_m.data(), 3, corners.data(), 1, &scene), ASPERITY_BAD_ARGUMENT);
    EXPECT_STREQ(asperity_last_error(), text);
    EXPECT_EQ(scene, nullptr);
  }
  const std::array<double, 3> far_m{0.0, 1e300, 0.0};
  const std::array<double, 4> turned{1.0, 0.0, 0.0, 0.0};
  EXPECT_EQ(asperity_scene_set_pose(scene_, 0, far_m.data(), turned.data()), ASPERITY_BAD_ARGUMENT);
  EXPECT_STREQ(asperity_last_error(), "position_m: point 0 is beyond 1e+06 m");
  const std::string long_name(10000, 'x');
  asperity_scene* none = nullptr;
  EXPECT_EQ(asperity_scene_read((long_name + ".obj").c_str(), &none), ASPERITY_BAD_FILE);

  // One step in the middle has the number; those 0.4 s later vibrate as they would without it, to 0.1 %.
  const auto vibration_N = [&](double number, int axis) {
    asperity_feel_reset(feel_);
    std::vector<asperity_motion> motions = stroke(700);
    motions[300].velocity_mps[axis] = number;
    std::vector<asperity_touch> touches(motions.size());
    for (asperity_touch& touch : touches) asperity_touch_init(&touch, sizeof touch);
    EXPECT_EQ(asperity_feel_steps(feel_, motions.data(), touches.data(), touches.size()), ASPERITY_OK);
    for (const asperity_touch& touch : touches) EXPECT_LE(std::abs(touch.vibration_N), 100.0) << number;
    return touches.back().vibration_N;
  };
  for (int axis = 0; axis < 3; ++axis) {
    const double usual_N = vibration_N(0.0, axis);
    for (const double number : {1e300, -1e300, 1e9, std::nan(""), std::numeric_limits<double>::infinity()})
      EXPECT_NEAR(vibration_N(number, axis), usual_N, 1e-3 * std::abs(usual_N)) << number << " along " << axis;
  }
}

// A program has no command line: errors name functions and parameters of this header.
TEST_F(CLibrary, ErrorsNameNoOptionOfACommandLine) {
  const auto has_option = [] { return std::string(asperity_last_error()).find("--") != std::string::npos; };
  EXPECT_EQ(asperity_settings_set(settings_, "zzzzzzzz", "1"), ASPERITY_BAD_ARGUMENT);
  EXPECT_STREQ(asperity_last_error(), "unknown setting 'zzzzzzzz'; asperity_settings_name() lists them");
  // Each setting with a value that it cannot have.
  for (std::size_t i = 0; i < asperity_settings_count(); ++i) {
    for (const char* value : {"zzz", "nan", "-1e300", "[1"}) {
      asperity_settings_set(settings_, asperity_settings_name(i), value);
      EXPECT_FALSE(has_option()) << asperity_last_error();
    }
  }
  // A mesh of 60 m, whose unit is asked for, and files that are none.
  const std::string mesh = (folder_.path() / "large.obj").string();
  std::ofstream(mesh) << "v 0 0 0\nv 60 0 0\nv 0 20 0\nf 1 2 3\n";
  asperity_scene* large = nullptr;
  EXPECT_EQ(asperity_scene_read(mesh.c_str(), &large), ASPERITY_BAD_FILE);
  EXPECT_FALSE(has_option()) << asperity_last_error();
  // Of a function that passes them on: their names in the header.
  const std::array<double, 4> forces{};
  std::size_t samples = 0;
  const auto sound = [&](double force_rate_Hz, double sample_rate_Hz, double volume, double full_scale_N) {
    EXPECT_EQ(asperity_vibration_samples(forces.data(), 4, force_rate_Hz, sample_rate_Hz, volume, full_scale_N, nullptr,
                                         0, &samples),
              ASPERITY_BAD_ARGUMENT);
    return std::string(asperity_last_error());
  };
  EXPECT_EQ(sound(1.0, 48000.0, 1.0, 1.0), "force_rate_Hz is 1, not from 100 to 4000");
  EXPECT_EQ(sound(1000.0, 1.0, 1.0, 1.0), "sample_rate_Hz is 1, not from 8000 to 192000");
  EXPECT_EQ(sound(1000.0, 48000.0, 2.0, 1.0), "volume is 2, not from 0 to 1");
  EXPECT_EQ(sound(1000.0, 48000.0, 1.0, 1e300), "full_scale_N is 1e+300, not from 0.001 to 1000");
  for (const char* content : {"{}", "v 1", "{\"format\": \"asperity-scene\", \"version\": 99}"}) {
    for (const char* name : {"bad.scene.json", "bad.obj", "bad.stl", "bad.glb"}) {
      const std::string file = (folder_.path() / name).string();
      std::ofstream(file) << content;
      asperity_scene* none = nullptr;
      EXPECT_NE(asperity_scene_read(file.c_str(), &none), ASPERITY_OK) << file;
      EXPECT_FALSE(has_option()) << asperity_last_error();
    }
  }
}

}  // namespace
}  // namespace asperity
