#include "asperity/render/render_step.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "asperity/testkit/shape_meshes.h"
#include "scenes.h"

namespace asperity {
namespace {

using Eigen::Vector3d;
using testing_render::at;
using testing_render::scene_of;
using testing_render::stroke;

constexpr double kStiffness = 1000.0;  // N/m, the config's
constexpr double kRounding_N = 1e-9;   // far above double's, far below a device's

TEST(RenderStep, PlaneGivesStiffnessTimesDepth) {
  for (const double radius_m : {0.0, 0.5e-3, 2e-3}) {
    RenderConfig config;
    config.tip_radius_m = radius_m;
    const RenderModel model = make_render_model(scene_of(testkit::plane_mesh({0.1, 0.1}, 40, 40, 0.2)), config);
    ServoState state;
    stroke(model, state, {0.03, 0.04, 0.01}, {0.03, 0.04, radius_m - 1e-3}, 1e-4);
    for (int k = 0; k < 300; ++k) {
      const double depth_m = 1e-3 + 1e-6 * k;
      const Vector3d p(0.03 + 1e-4 * k, 0.04 + 0.37e-4 * k, radius_m - depth_m);
      const ServoOutput out = render_step(model, state, at(p));
      ASSERT_NEAR(out.force_N.z(), kStiffness * depth_m, kRounding_N);
      ASSERT_NEAR(out.force_N.head<2>().norm(), 0.0, kRounding_N);
      ASSERT_NEAR((out.proxy_m - Vector3d(p.x(), p.y(), radius_m)).norm(), 0.0, 1e-12);
      ASSERT_TRUE(out.contact.found());
      // A triangle beside the foot is as near to rounding as long as it is within sqrt(2 R slack).
      ASSERT_NEAR((out.contact.p_world_m - Vector3d(p.x(), p.y(), 0.0)).norm(), 0.0, 1e-6);
    }
  }
}

TEST(RenderStep, NothingTouchedGivesNothing) {
  const RenderModel model = make_render_model(scene_of(testkit::plane_mesh({0.1, 0.1}, 40, 40)), {});
  ServoState state;
  const ServoOutput out = stroke(model, state, {0.01, 0.01, 0.01}, {0.09, 0.09, 0.002}, 1e-3);
  EXPECT_EQ(out.force_N, Vector3d::Zero());
  EXPECT_NEAR((out.proxy_m - Vector3d(0.09, 0.09, 0.002)).norm(), 0.0, 1e-15);
  EXPECT_FALSE(out.contact.found());
}

TEST(RenderStep, SphereFromOutsideAndInside) {
  const double radius_m = 0.03;
  for (const double tip_m : {0.0, 0.5e-3}) {
    RenderConfig config;
    config.tip_radius_m = tip_m;
    const RenderModel model = make_render_model(scene_of(testkit::sphere_mesh(radius_m, 6)), config);
    const double facet_m = radius_m * (1.0 - std::cos(0.5 * 0.0185)) * 4.0;  // sagitta of facets, edges 0.0185 rad
    ServoState state;
    const auto on_ray = [&](double depth_m, double angle) {
      return Vector3d(Vector3d(std::cos(angle), std::sin(angle), 0.2).normalized() * (radius_m + tip_m - depth_m));
    };
    stroke(model, state, 1.1 * on_ray(0.0, 0.0), on_ray(1e-3, 0.0), 1e-4);
    for (int k = 0; k < 2000; ++k) {
      const Vector3d p = on_ray(1e-3, 3e-3 * k);
      const ServoOutput out = render_step(model, state, at(p));
      ASSERT_NEAR(out.force_N.norm(), kStiffness * 1e-3, kStiffness * facet_m) << k;
      ASSERT_GT(out.force_N.normalized().dot(p.normalized()), std::cos(0.0185)) << k;
    }
  }
}

TEST(RenderStep, StartsInsideWithoutForceUntilItHasLeft) {
  const RenderModel model = make_render_model(scene_of(testkit::box_mesh({0.04, 0.04, 0.04}, 8)), {});
  ServoState state;
  for (double z = 0.02; z < 0.04; z += 1e-3) {
    const ServoOutput out = render_step(model, state, at({0.021, 0.018, z}));
    EXPECT_TRUE(out.starts_inside);
    EXPECT_EQ(out.force_N, Vector3d::Zero());
  }
  EXPECT_FALSE(render_step(model, state, at({0.021, 0.018, 0.0405})).starts_inside);
  EXPECT_NEAR(render_step(model, state, at({0.021, 0.018, 0.0395})).force_N.z(), 0.5, kRounding_N);
}

TEST(RenderStep, InputsThatAreNotFiniteGiveNoForceAndDoNoHarm) {
  const RenderModel model = make_render_model(scene_of(testkit::plane_mesh({0.1, 0.1}, 4, 4)), {});
  ServoState state;
  stroke(model, state, {0.05, 0.05, 0.01}, {0.05, 0.05, -1e-3}, 1e-4);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(render_step(model, state, at({nan, 0.0, 0.0})).force_N, Vector3d::Zero());
  EXPECT_NEAR(render_step(model, state, at({0.05, 0.05, -1e-3})).force_N.z(), 1.0, kRounding_N);
}

TEST(RenderStep, OfASurfaceWithoutStiffnessIsFiniteAndNothing) {
  Scene scene = scene_of(testkit::plane_mesh({0.1, 0.1}, 4, 4));
  scene.stiffness_N_per_m = 0.0;
  const RenderModel model = make_render_model(scene, {});
  ServoState state;
  const ServoOutput out = stroke(model, state, {0.031, 0.052, 1e-3}, {0.031, 0.052, -1e-3}, 1e-5);
  EXPECT_EQ(out.contact.weight, 1.0);
  EXPECT_EQ(out.force_N, Vector3d::Zero());
}

}  // namespace
}  // namespace asperity
