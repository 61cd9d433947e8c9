#pragma once

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <asperity_feel.h>
#include "asperity/base/random.h"
#include "asperity/render/render_step.h"
#include "asperity/scene/paint.h"
#include "asperity/scene/read_scene.h"
#include "asperity/testkit/shape_meshes.h"
#include "asperity/testkit/temp_dir.h"
#include "asperity/texture/texture_file.h"

namespace asperity::testkit {

// A plane of 40 × 20 mm with a wave of 2 mm along its middle, as a handle and as what the renderer makes of the same.
class CLibraryTest : public ::testing::Test {
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

    const TriangleMesh mesh = plane_mesh({0.04, 0.02}, 20, 10);
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

  TempDir folder_;
  std::string texture_file_;
  std::vector<double> vertices_m_;
  std::vector<unsigned> triangles_;
  Scene reference_;
  asperity_scene* scene_ = nullptr;
  asperity_settings* settings_ = nullptr;
  asperity_feel* feel_ = nullptr;
};

}  // namespace asperity::testkit
