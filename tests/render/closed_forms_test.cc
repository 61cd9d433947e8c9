// A tip without friction and texture on shapes whose force is known.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "asperity/base/random.h"
#include "asperity/testkit/shape_meshes.h"
#include "render_rig.h"

namespace asperity::render_test {
namespace {

using Eigen::Vector3d;

// Forces of 1 N agree to a micronewton where the shape is exact: the proxy's tolerance is relative to its size.
constexpr double kForceTol_N = 1e-6;

class Tips : public OfTipRadii {};
INSTANTIATE_TEST_SUITE_P(Radii, Tips, kRadii_m);

void expect_force(const ServoOutput& out, const Vector3d& force_N, double tolerance_N) {
  if (testing::Test::HasFailure()) return;  // one is enough: a path of thousands of steps fails as one
  EXPECT_LE((out.force_N - force_N).norm(), tolerance_N)
      << "force " << out.force_N.transpose() << " N, expected " << force_N.transpose();
  const Vector3d sum_N = out.contact_N + out.texture_N + out.friction_N;
  EXPECT_LE((sum_N - out.force_N).norm(), 1e-12 * (1.0 + out.force_N.norm()));
}

TEST_P(Tips, PlaneGivesStiffnessTimesDepth) {
  Rig rig(scene_of({sheet(40e-3, 23)}), config());
  expect_force(rig.go({0, 0, radius_m() + 1e-3}), Vector3d::Zero(), 0.0);
  expect_force(rig.go({0, 0, radius_m() + 1e-7}), Vector3d::Zero(), 0.0);
  Random random(11);
  for (int k = 0; k < 200; ++k) {
    const double depth_m = random.uniform(0.0, 3e-3);
    const Vector3d p(random.uniform(-15e-3, 15e-3), random.uniform(-15e-3, 15e-3), radius_m() - depth_m);
    const ServoOutput out = rig.go(p);
    expect_force(out, kStiffness_N_per_m * depth_m * Vector3d::UnitZ(), kForceTol_N);
    EXPECT_LE((out.proxy_m - Vector3d(p.x(), p.y(), radius_m())).norm(), 1e-9);
    if (depth_m < 1e-6) continue;
    ASSERT_TRUE(out.contact.found());
    EXPECT_LE((out.contact.p_world_m - Vector3d(p.x(), p.y(), 0.0)).norm(), 1e-9);
    EXPECT_LE((out.contact.normal_world - Vector3d::UnitZ()).norm(), 1e-9);
  }
  expect_force(rig.go({1e-3, 2e-3, radius_m() + 1e-4}), Vector3d::Zero(), 0.0);
  EXPECT_FALSE(rig.go({1e-3, 2e-3, radius_m() + 1e-3}).contact.found());
}

TEST_P(Tips, SphereGivesARadialForce) {
  constexpr double kRadius_m = 50e-3;
  // Facets lie below the sphere by up to c²/2R and are turned by up to c/R, c = 0.65 mm their circumradius.
  constexpr double kSagitta_m = 5e-6, kTurn_rad = 0.015;
  Rig rig(scene_of({testkit::sphere_mesh(kRadius_m, 6)}), config());
  Random random(12);
  Vector3d u = Vector3d(1.0, 0.3, -0.5).normalized();
  rig.step((kRadius_m + radius_m() + 2e-3) * u);
  for (int k = 0; k < 60; ++k) {
    const double depth_m = random.uniform(0.1e-3, 1.5e-3);
    u = (u + 0.05 * Vector3d(random.normal(), random.normal(), random.normal())).normalized();
    const ServoOutput out = rig.go((kRadius_m + radius_m() - depth_m) * u);
    const double force_N = out.force_N.norm();
    EXPECT_NEAR(force_N, kStiffness_N_per_m * depth_m, kStiffness_N_per_m * kSagitta_m);
    EXPECT_LE(std::acos(std::min(1.0, out.force_N.dot(u) / force_N)), kTurn_rad);
  }
}

TEST_P(Tips, GrooveHoldsTheTipInItsBottom) {
  Rig rig(scene_of({fold(1.0, 40e-3, 9)}), config());
  const Vector3d rest(0.0, 0.0, std::sqrt(2.0) * radius_m());
  rig.go(rest + Vector3d(1e-4, 0.0, 5e-3));
  Random random(13);
  for (int k = 0; k < 200; ++k) {
    // In the cone below the bottom, −z >= |x|, both sides hold.
    const double z_m = random.uniform(-2e-3, -1e-4), x_m = random.uniform(-0.99, 0.99) * z_m;
    const Vector3d p = rest + Vector3d(x_m, random.uniform(-10e-3, 10e-3), z_m);
    expect_force(rig.go(p), Vector3d(-kStiffness_N_per_m * x_m, 0.0, -kStiffness_N_per_m * z_m), kForceTol_N);
  }
}

TEST_P(Tips, GrooveHasOneSideAwayFromItsBottom) {
  Rig rig(scene_of({fold(1.0, 40e-3, 9)}), config());
  const Vector3d n = Vector3d(-1.0, 0.0, 1.0).normalized();  // of the side x > 0
  const Vector3d along = Vector3d(1.0, 0.0, 1.0).normalized();
  rig.go(Vector3d(0, 0, 8e-3));
  for (const double s_m : {6e-3, 8e-3, 5e-3, 9e-3}) {
    expect_force(rig.go(s_m * along + (radius_m() - 1e-3) * n), kStiffness_N_per_m * 1e-3 * n, kForceTol_N);
  }
}

TEST(Ridge, PointStaysOnItsSideUntilTheMinimumVanishes) {
  Rig rig(scene_of({fold(-1.0, 40e-3, 9)}));
  const Vector3d left = Vector3d(-1.0, 0.0, 1.0).normalized();
  constexpr double kHeight_m = 1e-3;  // below the crest
  rig.go({-3e-3, 0.0, 1e-3});
  rig.go({-3e-3, 0.0, -2e-3});
  for (double x_m = -0.9e-3; x_m < 0.99 * kHeight_m; x_m += 20e-6) {
    const Vector3d p(x_m, 0.3e-3, -kHeight_m);
    const double depth_m = -(p.dot(left));
    expect_force(rig.go(p), kStiffness_N_per_m * depth_m * left, kForceTol_N);
  }
  // Beyond |z| it comes out on the other side.
  expect_force(rig.go({1.02e-3, 0.3e-3, -kHeight_m}), Vector3d::Zero(), kForceTol_N);
}

TEST(Ridge, PointSlidesOverTheCrestToTheOtherSide) {
  Rig rig(scene_of({fold(-1.0, 40e-3, 9)}));
  const Vector3d left = Vector3d(-1.0, 0.0, 1.0).normalized(), right(-left.x(), 0.0, left.z());
  rig.go({-1e-3, 0.0, 1e-3});
  rig.go({-0.2e-3, 0.0, -1e-3});
  // Up along the left side at a constant depth: the foot passes the crest inside the object.
  const Vector3d up = Vector3d(1.0, 0.0, 1.0).normalized();
  const Vector3d p = 0.05e-3 * up - 0.5e-3 * left;
  const double depth_m = -p.dot(right);
  EXPECT_LT(depth_m, 0.0);  // there it is outside of the right side: free
  expect_force(rig.go(p), Vector3d::Zero(), kForceTol_N);
}

TEST(Ridge, BallRollsOverTheCrestOnAFillet) {
  constexpr double kTip_m = 2e-3, kHeight_m = 1.2e-3;
  RenderConfig config;
  config.tip_radius_m = kTip_m;
  Rig rig(scene_of({fold(-1.0, 40e-3, 9)}), config);
  rig.go({-4e-3, 0.0, 4e-3});
  rig.go({-1.2e-3, 0.0, kHeight_m});
  for (double x_m = -1.19e-3; x_m < 1.2e-3; x_m += 10e-6) {
    // Within |x| <= z the crest touches: the offset surface is a cylinder about it. To 0.3 mN: the descent on a
    // curved surface is iterative.
    const Vector3d p(x_m, 0.4e-3, kHeight_m), radial(x_m, 0.0, kHeight_m);
    const double depth_m = kTip_m - radial.norm();
    expect_force(rig.go(p), kStiffness_N_per_m * depth_m * radial.normalized(), 3e-4);
  }
  const Vector3d right = Vector3d(1.0, 0.0, 1.0).normalized();
  const Vector3d p = 4e-3 * Vector3d(1.0, 0.0, -1.0).normalized() + (kTip_m - 1e-3) * right;
  expect_force(rig.go(p), kStiffness_N_per_m * 1e-3 * right, kForceTol_N);
}

TEST_P(Tips, CylinderFromOutside) {
  constexpr double kRadius_m = 20e-3;
  constexpr int kAround = 720;  // facets 0.17 mm wide: sagitta 0.2 µm, turned by up to 4.4 mrad
  Rig rig(scene_of({testkit::cylinder_mesh(kRadius_m, 60e-3, kAround, 20, 2.0 * std::numbers::pi)}), config());
  const auto at = [](double angle, double radius, double z) {
    return Vector3d(radius * std::cos(angle), radius * std::sin(angle), z);
  };
  rig.step(at(0.0, kRadius_m + radius_m() + 1e-3, 30e-3));
  for (int k = 0; k < 400; ++k) {
    const double angle = 0.01 * k, z_m = 30e-3 + 20e-3 * std::sin(0.02 * k);
    const ServoOutput out = rig.go(at(angle, kRadius_m + radius_m() - 1e-3, z_m));
    EXPECT_LE((out.force_N - at(angle, 1.0, 0.0)).norm(), 5e-3);
  }
}

TEST(Pipe, PressesInwardsOnATipInside) {
  constexpr double kRadius_m = 20e-3, kTip_m = 2e-3;
  RenderConfig config;
  config.tip_radius_m = kTip_m;
  Rig rig(scene_of({testkit::cylinder_mesh(kRadius_m, 60e-3, 720, 20, 2.0 * std::numbers::pi)}), config);
  rig.step({0, 0, 30e-3});
  for (int k = 0; k < 300; ++k) {
    const Vector3d radial(std::cos(0.02 * k), std::sin(0.02 * k), 0.0);
    const ServoOutput out = rig.go((kRadius_m - kTip_m + 1e-3) * radial + 30e-3 * Vector3d::UnitZ());
    EXPECT_LE((out.force_N + radial).norm(), 5e-3);
  }
}

TEST_P(Tips, CornerOfThreeWallsHoldsInAllDirections) {
  // Three sheets that cross: at x, y and z = 0, each facing inwards.
  const TriangleMesh floor = moved(testkit::plane_mesh({20e-3, 20e-3}, 7, 7), {-5e-3, -5e-3, 0.0});
  TriangleMesh wall_x = floor, wall_y = floor;
  for (Vector3d& p : wall_x.vertices_m) p = Vector3d(p.z(), p.x(), p.y());
  for (Vector3d& p : wall_y.vertices_m) p = Vector3d(p.y(), p.z(), p.x());
  Rig rig(scene_of({floor, wall_x, wall_y}), config());
  const Vector3d rest = Vector3d::Constant(radius_m());
  rig.step(rest + Vector3d::Constant(2e-3));
  Random random(14);
  for (int k = 0; k < 100; ++k) {
    const Vector3d into(random.uniform(0, 2e-3), random.uniform(0, 2e-3), random.uniform(0, 2e-3));
    expect_force(rig.go(rest - into), kStiffness_N_per_m * into, kForceTol_N);
  }
}

}  // namespace
}  // namespace asperity::render_test
