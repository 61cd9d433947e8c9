// Several, moving, open, non-manifold and thin objects; tips that begin inside.
#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "asperity/geometry/pose.h"
#include "asperity/testkit/shape_meshes.h"
#include "render_rig.h"

namespace asperity::render_test {
namespace {

using Eigen::Vector3d;

constexpr double kForceTol_N = 1e-6;

class Objects : public OfTipRadii {};
INSTANTIATE_TEST_SUITE_P(Radii, Objects, kRadii_m);

TEST_P(Objects, AreFeltTogether) {
  TriangleMesh wall = sheet(40e-3, 8);
  for (Vector3d& p : wall.vertices_m) p = Vector3d(p.z(), p.x(), p.y());  // x = 0, facing +x
  Rig rig(scene_of({sheet(40e-3, 11), wall}), config());
  rig.step({5e-3, 0, 5e-3});
  const ServoOutput both = rig.go({radius_m() - 0.7e-3, 1e-3, radius_m() - 1.1e-3});
  EXPECT_LE((both.force_N - Vector3d(0.7, 0.0, 1.1)).norm(), kForceTol_N);
  const ServoOutput floor = rig.go({6e-3, 1e-3, radius_m() - 1.1e-3});
  EXPECT_LE((floor.force_N - Vector3d(0.0, 0.0, 1.1)).norm(), kForceTol_N);
  EXPECT_EQ(floor.contact.object, 0u);
  const ServoOutput side = rig.go({radius_m() - 0.7e-3, 1e-3, 6e-3});
  EXPECT_LE((side.force_N - Vector3d(0.7, 0.0, 0.0)).norm(), kForceTol_N);
  EXPECT_EQ(side.contact.object, 1u);
}

TEST_P(Objects, StandWhereTheScenePutsThem) {
  Scene scene = scene_of({sheet(40e-3, 11)});
  const Pose T_world_mesh{Eigen::Quaterniond(Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized())), {0.1, -0.2, 0.3}};
  scene.objects[0].T_world_mesh = T_world_mesh;
  Rig rig(scene, config());
  rig.step(T_world_mesh * Vector3d(0, 0, 5e-3));
  const ServoOutput out = rig.go(T_world_mesh * Vector3d(1e-3, 2e-3, radius_m() - 1e-3));
  EXPECT_LE((out.force_N - T_world_mesh.rotation * Vector3d::UnitZ()).norm(), kForceTol_N);
}

TEST_P(Objects, WallThatComesPressesARestingTip) {
  Rig rig(scene_of({sheet(40e-3, 11)}), config());
  Pose& T_world_mesh = rig.model.objects[0].T_world_mesh;
  T_world_mesh.translation_m.z() = -1e-3;
  const Vector3d p(1e-3, 2e-3, radius_m());
  rig.step(p);
  for (int k = 0; k <= 300; ++k) {  // 10 mm/s
    T_world_mesh.translation_m.z() = -1e-3 + 10e-6 * k;
    const double depth_m = std::max(0.0, T_world_mesh.translation_m.z());
    ASSERT_LE((rig.step(p).force_N - Vector3d(0, 0, kStiffness_N_per_m * depth_m)).norm(), kForceTol_N) << k;
  }
}

TEST_P(Objects, WallThatGoesLeavesTheTip) {
  Rig rig(scene_of({sheet(40e-3, 11)}), config());
  rig.step({0, 0, 5e-3});
  const Vector3d p(1e-3, 2e-3, radius_m() - 1e-3);
  rig.go(p);
  Pose& T_world_mesh = rig.model.objects[0].T_world_mesh;
  for (int k = 0; k <= 200; ++k) {
    T_world_mesh.translation_m.z() = -10e-6 * k;
    const double depth_m = std::max(0.0, 1e-3 - 10e-6 * k);
    ASSERT_LE((rig.step(p).force_N - Vector3d(0, 0, kStiffness_N_per_m * depth_m)).norm(), kForceTol_N) << k;
  }
}

TEST_P(Objects, TurntableCarriesAStickingProxyAndThenSlipsUnderIt) {
  RenderConfig with_friction = config();
  with_friction.friction = 0.5;
  with_friction.static_friction_ratio = 1.2;
  Rig rig(scene_of({sheet(80e-3, 11)}), with_friction);
  constexpr double kArm_m = 20e-3, kDepth_m = 1e-3, kTurn_rad = 1e-4;  // a tick: 2 mm/s at the arm
  rig.step({kArm_m, 0, 5e-3 + radius_m()});
  const Vector3d p(kArm_m, 0, radius_m() - kDepth_m);
  rig.go(p);
  double largest_N = 0.0;
  ServoOutput out;
  for (int k = 1; k <= 1500; ++k) {
    const double angle = kTurn_rad * k;
    rig.model.objects[0].T_world_mesh.rotation = Eigen::AngleAxisd(angle, Vector3d::UnitZ());
    out = rig.step(p);
    ASSERT_NEAR(out.contact_N.z(), 1.0, 1e-5);
    const Vector3d carried_m = kArm_m * Vector3d(std::cos(angle), std::sin(angle), 0) - Vector3d(kArm_m, 0, 0);
    if (carried_m.norm() < 0.59e-3) {
      ASSERT_LE((out.friction_N - kStiffness_N_per_m * carried_m).norm(), 1e-5) << k;
      ASSERT_TRUE(out.sticking) << k;
    }
    largest_N = std::max(largest_N, out.friction_N.norm());
  }
  EXPECT_NEAR(largest_N, 0.6, 5e-3);  // μ_s f_n, found to a tick's 2 µm
  EXPECT_NEAR(out.friction_N.norm(), 0.5, 1e-3);
  EXPECT_GT(out.friction_N.y(), 0.49);  // the way the table goes
}

TEST_P(Objects, SheetIsFeltFromBothSides) {
  Rig rig(scene_of({sheet(40e-3, 11)}), config());
  rig.step({0, 0, -5e-3});
  const ServoOutput below = rig.go({1e-3, 0, 1e-3 - radius_m()});
  EXPECT_LE((below.force_N - Vector3d(0, 0, -1.0)).norm(), kForceTol_N);
  EXPECT_LE((below.contact.normal_world + Vector3d::UnitZ()).norm(), 1e-9);
  EXPECT_FALSE(below.starts_inside);
}

TEST(Sheet, LetsGoBeyondItsBorder) {
  Rig rig(scene_of({sheet(40e-3, 11)}));
  rig.step({0, 0, 5e-3});
  rig.go({18e-3, 1e-3, -1e-3});
  EXPECT_LE((rig.go({19.99e-3, 1e-3, -1e-3}).force_N - Vector3d(0, 0, 1.0)).norm(), kForceTol_N);
  EXPECT_LE(rig.go({20.1e-3, 1e-3, -1e-3}).force_N.norm(), kForceTol_N);
  // And it is then below: coming back presses from there.
  EXPECT_LE(rig.go({15e-3, 1e-3, -1e-3}).force_N.norm(), kForceTol_N);
  EXPECT_LE((rig.go({15e-3, 1e-3, 1e-3}).force_N - Vector3d(0, 0, -1.0)).norm(), kForceTol_N);
}

TEST_P(Objects, FinOnASheetStopsTheTip) {
  // Three sheets meet in one edge: x < 0, x > 0 and a fin upwards.
  constexpr double kSize_m = 20e-3;
  const TriangleMesh mesh{{{0, -kSize_m, 0},
                           {0, kSize_m, 0},
                           {-kSize_m, -kSize_m, 0},
                           {-kSize_m, kSize_m, 0},
                           {kSize_m, -kSize_m, 0},
                           {kSize_m, kSize_m, 0},
                           {0, -kSize_m, kSize_m},
                           {0, kSize_m, kSize_m}},
                          {{2, 0, 1}, {2, 1, 3}, {0, 4, 5}, {0, 5, 1}, {0, 1, 7}, {0, 7, 6}}};
  Rig rig(scene_of({mesh}), config());
  rig.step({-8e-3, 0.1e-3, 5e-3});
  const ServoOutput out = rig.go({1e-3 - radius_m(), 0.2e-3, radius_m() - 1e-3});
  EXPECT_LE((out.force_N - Vector3d(-1.0, 0.0, 1.0)).norm(), kForceTol_N);
  const ServoOutput far = rig.go({8e-3, 0.3e-3, radius_m() - 1e-3}, 0.1e-3);
  EXPECT_LE((far.proxy_m - Vector3d(-radius_m(), 0.3e-3, radius_m())).norm(), 1e-9);
}

TEST_P(Objects, NoForceUntilATipThatBeganInsideHasLeft) {
  Rig rig(scene_of({testkit::box_mesh({20e-3, 20e-3, 20e-3}, 5)}), config());
  const double above_m = 20e-3 + radius_m();
  EXPECT_EQ(rig.step({10e-3, 10e-3, 18e-3}).force_N.norm(), 0.0);
  EXPECT_TRUE(rig.step({10e-3, 10e-3, 18e-3}).starts_inside);
  EXPECT_EQ(rig.go({12e-3, 9e-3, 5e-3}).force_N.norm(), 0.0);
  const ServoOutput nearly = rig.go({12e-3, 9e-3, above_m - 0.05e-3});
  EXPECT_EQ(nearly.force_N.norm(), 0.0);
  EXPECT_TRUE(nearly.starts_inside);
  EXPECT_FALSE(rig.go({12e-3, 9e-3, above_m + 1e-3}).starts_inside);
  const ServoOutput again = rig.go({12e-3, 9e-3, above_m - 1e-3});
  EXPECT_LE((again.force_N - Vector3d(0, 0, 1.0)).norm(), kForceTol_N);
}

TEST_P(Objects, JumpThroughAThinPlateStaysOnItsSide) {
  Rig rig(scene_of({testkit::box_mesh({20e-3, 20e-3, 0.2e-3}, 5)}), config());
  rig.step({10e-3, 10e-3, 5e-3});
  const ServoOutput out = rig.step({11e-3, 10.5e-3, -5e-3});
  EXPECT_NEAR(out.proxy_m.z(), 0.2e-3 + radius_m(), 1e-9);
  EXPECT_LE((out.force_N - Vector3d(0, 0, 5.2 + kStiffness_N_per_m * radius_m())).norm(), 1e-5);
}

TEST_P(Objects, JumpThroughASheetStaysOnItsSide) {
  Rig rig(scene_of({sheet(40e-3, 31)}), config());
  rig.step({-10e-3, -10e-3, 5e-3});
  const ServoOutput out = rig.step({10e-3, 9e-3, -5e-3});
  EXPECT_LE((out.proxy_m - Vector3d(10e-3, 9e-3, radius_m())).norm(), 1e-9);
}

TEST_P(Objects, WhatIsNotFiniteGivesNoForceAndDoesNoHarm) {
  Rig rig(scene_of({sheet(40e-3, 11)}), config());
  rig.step({0, 0, 5e-3});
  const Vector3d p(1e-3, 0, radius_m() - 1e-3);
  rig.go(p);
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, inf, -inf}) {
    DeviceState device = rig.device;
    device.p_world_m.y() = bad;
    EXPECT_EQ(render_step(rig.model, rig.state, device).force_N, Vector3d::Zero());
    device = rig.device;
    device.v_world_mps.x() = bad;
    EXPECT_EQ(render_step(rig.model, rig.state, device).force_N, Vector3d::Zero());
    device = rig.device;
    device.dt_s = bad;
    EXPECT_EQ(render_step(rig.model, rig.state, device).force_N, Vector3d::Zero());
    EXPECT_LE((rig.step(p).force_N - Vector3d(0, 0, 1.0)).norm(), kForceTol_N);
  }
  const ServoOutput huge = rig.step({1e300, -1e300, 1e300});
  EXPECT_TRUE(huge.force_N.allFinite());
}

}  // namespace
}  // namespace asperity::render_test
