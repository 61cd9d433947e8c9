// Coulomb friction by the proxy: it sticks within the static cone and slides at the edge of the kinetic one.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "asperity/testkit/shape_meshes.h"
#include "render_rig.h"

namespace asperity::render_test {
namespace {

using Eigen::Vector3d;

constexpr double kSliding = 0.5, kStaticRatio = 1.2, kDepth_m = 1e-3;

class Friction : public OfTipRadii {
 protected:
  RenderConfig config() const {
    RenderConfig config = OfTipRadii::config();
    config.friction = kSliding;
    config.static_friction_ratio = kStaticRatio;
    return config;
  }
  Vector3d at(double x_m, double y_m) const { return {x_m, y_m, radius_m() - kDepth_m}; }
};
INSTANTIATE_TEST_SUITE_P(Radii, Friction, kRadii_m);

TEST_P(Friction, HoldsBelowTheStaticLimitThenSlidesEvenly) {
  Rig rig(scene_of({sheet(60e-3, 37)}), config());
  rig.step({-20e-3, 0, 5e-3});
  rig.go(at(-20e-3, 0));
  double low_N = 1e9, high_N = 0.0;
  for (int k = 1; k <= 2000; ++k) {  // 20 mm/s
    const double s_m = 20e-6 * k;
    const ServoOutput out = rig.step(at(-20e-3 + s_m, 0));
    ASSERT_NEAR(out.contact_N.z(), 1.0, settled_N(radius_m()));
    ASSERT_LE(out.contact_N.head<2>().norm(), settled_N(radius_m()));
    ASSERT_LE(std::abs(out.friction_N.z()), settled_N(radius_m()));
    if (s_m < 0.599e-3) {
      ASSERT_LE((out.friction_N - Vector3d(-kStiffness_N_per_m * s_m, 0, 0)).norm(), 1e-6) << k;
      ASSERT_TRUE(out.sticking);
    }
    ASSERT_LE(out.friction_N.norm(), kSliding * kStaticRatio * out.contact_N.norm() * (1.0 + 1e-9));
    if (s_m > 2e-3) {
      ASSERT_LT(out.friction_N.x(), 0.0);
      low_N = std::min(low_N, out.friction_N.norm());
      high_N = std::max(high_N, out.friction_N.norm());
    }
  }
  // No sawtooth: sliding on at a steady speed, the force is that of sliding.
  EXPECT_NEAR(low_N, kSliding, 1e-6);
  EXPECT_NEAR(high_N, kSliding, 1e-6);
}

TEST_P(Friction, TurnsWithTheDirectionOfSliding) {
  Rig rig(scene_of({sheet(60e-3, 37)}), config());
  rig.step({10e-3, 0, 5e-3});
  rig.go(at(10e-3, 0));
  constexpr double kArm_m = 10e-3;
  ServoOutput out;
  Vector3d before = Vector3d::Zero();
  for (int k = 0; k <= 3000; ++k) {
    const double angle = 2e-3 * k;
    before = out.proxy_m;
    out = rig.step(at(kArm_m * std::cos(angle), kArm_m * std::sin(angle)));
    if (k < 300) continue;
    const Vector3d slid = out.proxy_m - before;
    ASSERT_LT(out.friction_N.dot(slid), -0.99 * out.friction_N.norm() * slid.norm()) << k;
    ASSERT_NEAR(out.friction_N.norm(), kSliding, 1e-4) << k;
  }
}

TEST_P(Friction, TipAtRestIsHeldStill) {
  Rig rig(scene_of({sheet(60e-3, 37)}), config());
  rig.step({0, 0, 5e-3});
  rig.go(at(0, 0));
  rig.go(at(0.3e-3, 0));
  const ServoOutput first = rig.step(at(0.3e-3, 0));
  EXPECT_NEAR(first.friction_N.x(), -0.3, 1e-6);
  for (int k = 0; k < 1000; ++k) {
    const ServoOutput out = rig.step(at(0.3e-3, 0));
    ASSERT_LE((out.force_N - first.force_N).norm(), 1e-9);
    ASSERT_TRUE(out.sticking);
  }
}

TEST_P(Friction, PressingStraightInHasNone) {
  Rig rig(scene_of({sheet(60e-3, 37)}), config());
  rig.step({1e-3, 2e-3, 5e-3});
  for (int k = 0; k < 100; ++k) {
    EXPECT_LE(rig.step({1e-3, 2e-3, radius_m() + 1e-3 - 20e-6 * k}).friction_N.norm(), 1e-9);
  }
}

TEST_P(Friction, ProxySlidesDownASlopeSteeperThanTheCone) {
  // Straight down onto a slope of 45°: tan 45° is beyond the static 0.6. It slides until the pull is at the kinetic
  // edge.
  Rig rig(scene_of({fold(1.0, 60e-3, 15)}), config());
  const Vector3d n = Vector3d(-1.0, 0.0, 1.0).normalized(), up = Vector3d(1.0, 0.0, 1.0).normalized();
  const Vector3d start = 15e-3 * up + radius_m() * n;
  rig.step(start + Vector3d(0, 0, 3e-3));
  ServoOutput out;
  for (int k = 0; k <= 200; ++k) out = rig.step(start - Vector3d(0, 0, 10e-6 * k));
  EXPECT_LE(out.friction_N.norm(), kSliding * kStaticRatio * out.contact_N.norm() * (1.0 + 1e-9));
  EXPECT_NEAR(out.contact_N.norm(), 2.0 / std::sqrt(2.0), 1e-5);
  EXPECT_GT(out.friction_N.dot(up), 0.49 * out.contact_N.norm());  // against sliding down
}

TEST_P(Friction, IsBoundedOverASphere) {
  const TriangleMesh ball = testkit::sphere_mesh(50e-3, 5);
  Rig rig(scene_of({ball}), config());
  rig.step((52e-3 + radius_m()) * Vector3d::UnitX());
  Vector3d before = Vector3d::Zero();
  int against = 0, slides = 0;
  for (int k = 0; k < 4000; ++k) {
    const double angle = 4e-4 * k;  // 20 mm/s
    const double down_m = std::min(20e-6 * k, 3e-3);
    const Vector3d radial(std::cos(angle), std::sin(angle), 0.2 * std::sin(3.0 * angle));
    const ServoOutput out = rig.step((52e-3 + radius_m() - down_m) * radial.normalized());
    ASSERT_LE(out.friction_N.norm(), kSliding * kStaticRatio * out.contact_N.norm() * (1.0 + 1e-6) + 1e-9) << k;
    ASSERT_LE(std::abs(out.friction_N.dot(out.contact_N)), 1e-6);
    const Vector3d slid = out.proxy_m - before;
    if (k > 500 && !out.sticking) {
      ++slides;
      against += out.friction_N.dot(slid) < 0.0;
    }
    before = out.proxy_m;
  }
  EXPECT_GT(slides, 3000);
  EXPECT_EQ(against, slides);
}

}  // namespace
}  // namespace asperity::render_test
