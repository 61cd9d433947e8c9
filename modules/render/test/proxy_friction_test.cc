#include <cmath>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "asperity/testkit/shape_meshes.h"
#include "scenes.h"

namespace asperity {
namespace {

using Eigen::Vector3d;
using testing_render::at;
using testing_render::object_of;
using testing_render::scene_of;
using testing_render::stroke;

constexpr double kStiffness = 1000.0;
constexpr double kRounding_N = 1e-9;

RenderModel rough_plane(double tip_m = 0.0) {
  RenderConfig config;
  config.tip_radius_m = tip_m;
  config.friction = 0.4;
  config.static_friction_ratio = 1.5;
  return make_render_model(scene_of(testkit::plane_mesh({0.1, 0.1}, 20, 20, 0.2)), config);
}

TEST(ProxyFriction, SticksUpToItsLoadAndThenSlides) {
  const RenderModel model = rough_plane();
  ServoState state;
  stroke(model, state, {0.05, 0.05, 0.01}, {0.05, 0.05, -1e-3}, 1e-4);  // 1 N
  bool slid = false;
  for (int k = 0; k < 2000; ++k) {
    const double x_m = 1e-6 * k;
    const ServoOutput out = render_step(model, state, at({0.05 + x_m, 0.05, -1e-3}));
    ASSERT_NEAR(out.contact_N.z(), 1.0, kRounding_N);
    if (x_m < 0.6e-3 - 1e-9) {  // 0.6 N: static
      ASSERT_TRUE(out.sticking) << k;
      ASSERT_NEAR(out.friction_N.x(), -kStiffness * x_m, kRounding_N);
    } else if (x_m > 0.6e-3 + 1e-9) {
      ASSERT_FALSE(out.sticking) << k;
      ASSERT_NEAR(out.friction_N.x(), -0.4, kRounding_N) << k;
      slid = true;
    }
    ASSERT_NEAR(out.friction_N.y(), 0.0, kRounding_N);
  }
  EXPECT_TRUE(slid);
  // Back: it sticks at once and has to be pulled the other way.
  const ServoOutput back = render_step(model, state, at({0.05 + 1.9e-3, 0.05, -1e-3}));
  EXPECT_TRUE(back.sticking);
  EXPECT_LT(back.friction_N.norm(), 0.4);
}

// The lag at which a tip under 1 N begins to slide.
double breakaway_m(const RenderModel& model, double x_m) {
  ServoState state;
  stroke(model, state, {x_m, 0.05, 0.01}, {x_m, 0.05, -1e-3}, 1e-4);
  for (int k = 0; k < 3000; ++k) {
    if (!render_step(model, state, at({x_m + 1e-6 * k, 0.05, -1e-3})).sticking) return 1e-6 * k;
  }
  return 0.0;
}

TEST(ProxyFriction, TheSceneKnowsHowMuchMoreStickingBears) {
  RenderConfig config;
  config.friction = 0.4;
  config.static_friction_ratio = 1.5;
  Scene scene = scene_of(testkit::plane_mesh({0.1, 0.1}, 20, 20, 0.2));
  EXPECT_NEAR(breakaway_m(make_render_model(scene, config), 0.05), 0.6e-3, 2e-6);
  scene.static_friction_ratio = 2.0;
  EXPECT_NEAR(breakaway_m(make_render_model(scene, config), 0.05), 0.8e-3, 2e-6);
  // The map's ratio, 1 at x = 0 and 2 at x = 0.1 m, between them in the middle: of the place that it sticks to.
  for (const Vector3d& v : scene.objects[0].mesh.vertices) {
    Material material;
    material.static_friction_ratio = 1.0 + v.x() / 0.1;
    scene.objects[0].material.vertices.push_back(material);
  }
  EXPECT_NEAR(breakaway_m(make_render_model(scene, config), 0.025), 0.4e-3 * 1.25, 2e-6);
  EXPECT_NEAR(breakaway_m(make_render_model(scene, config), 0.075), 0.4e-3 * 1.75, 2e-6);
}

TEST(ProxyFriction, LiftedTipIsLetGo) {
  const RenderModel model = rough_plane();
  ServoState state;
  stroke(model, state, {0.05, 0.05, 0.01}, {0.05, 0.05, -1e-3}, 1e-4);
  stroke(model, state, {0.05, 0.05, -1e-3}, {0.0502, 0.05, -1e-3}, 1e-5);
  const ServoOutput out = stroke(model, state, {0.0502, 0.05, -1e-3}, {0.0502, 0.05, 1e-3}, 1e-4);
  EXPECT_EQ(out.force_N, Vector3d::Zero());
  EXPECT_FALSE(out.sticking);
  EXPECT_NEAR((out.proxy_m - Vector3d(0.0502, 0.05, 1e-3)).norm(), 0.0, 1e-15);
}

TEST(ProxyFriction, NeverExceedsTheCone) {
  const RenderModel model = rough_plane(1e-3);
  ServoState state;
  stroke(model, state, {0.05, 0.05, 0.01}, {0.05, 0.05, 0.0}, 1e-4);
  for (int k = 0; k < 5000; ++k) {
    const Vector3d p(0.05 + 2e-3 * std::sin(0.01 * k), 0.05 + 1e-3 * std::cos(0.023 * k), 2e-4 * std::sin(0.05 * k));
    const ServoOutput out = render_step(model, state, at(p));
    ASSERT_TRUE(out.force_N.allFinite());
    ASSERT_LE(out.friction_N.norm(), 0.6 * out.contact_N.norm() + kRounding_N);
  }
}

TEST(ProxyFriction, AMovingPlaneDragsTheTip) {
  RenderModel model = rough_plane();
  ServoState state;
  const Vector3d p(0.05, 0.05, -1e-3);
  stroke(model, state, {0.05, 0.05, 0.01}, p, 1e-4);
  for (int k = 1; k <= 500; ++k) {
    model.objects[0].T_world_mesh.translation_m.y() = 1e-6 * k;
    const ServoOutput out = render_step(model, state, at(p));
    ASSERT_TRUE(out.sticking);
    ASSERT_NEAR(out.friction_N.y(), kStiffness * 1e-6 * k, 1e-7);
    ASSERT_NEAR(out.contact_N.z(), 1.0, 1e-7);
  }
}

TEST(ProxyMotion, AWallThatComesPushesAndNeverPasses) {
  RenderConfig config;
  config.tip_radius_m = 0.5e-3;
  RenderModel model = make_render_model(scene_of(testkit::plane_mesh({0.1, 0.1}, 20, 20, 0.2)), config);
  Pose& T = model.objects[0].T_world_mesh;
  T.translation_m.z() = -0.01;
  ServoState state;
  const Vector3d p(0.05, 0.05, 0.0);
  for (int k = 0; k <= 400; ++k) {
    T.translation_m.z() = -0.01 + 5e-5 * k;
    const ServoOutput out = render_step(model, state, at(p));
    const double depth_m = std::max(0.0, T.translation_m.z() + 0.5e-3);
    ASSERT_NEAR(out.force_N.z(), kStiffness * depth_m, 1e-7) << k;
  }
}

TEST(ProxyMotion, ATurningBoxPushesTheTipRound) {
  RenderModel model = make_render_model(scene_of(testkit::box_mesh({0.04, 0.04, 0.04}, 8)), {});
  Pose& T = model.objects[0].T_world_mesh;
  ServoState state;
  const Vector3d p(0.035, 0.041, 0.02);
  double most_m = 0.0;
  for (int k = 0; k < 700; ++k) {
    T.rotation = Eigen::Quaterniond(Eigen::AngleAxisd(1e-3 * k, Vector3d::UnitZ()));
    const ServoOutput out = render_step(model, state, at(p));
    const Vector3d q = T.inverse() * p;
    const double depth_m = q.minCoeff() > 0.0 && q.maxCoeff() < 0.04 ? std::min(0.04 - q.x(), 0.04 - q.y()) : 0.0;
    most_m = std::max(most_m, depth_m);
    // It may be the other face that the tip came by.
    ASSERT_GE(out.force_N.norm(), kStiffness * depth_m - 1e-6) << k;
    ASSERT_LT(out.force_N.norm(), kStiffness * 0.03) << k;
    ASSERT_GT((model.objects[0].bvh.closest_point(T.inverse() * state.proxy.p_world_m)).distance_m, 0.0);
  }
  EXPECT_GT(most_m, 1e-3);
}

}  // namespace
}  // namespace asperity
