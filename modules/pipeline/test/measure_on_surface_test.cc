#include "../src/measure_on_surface.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "asperity/base/random.h"

namespace asperity {
namespace {

constexpr double kRadius_m = 0.035, kTurned = 2.5;
constexpr double kCompliance_mpN = 0.3e-3;

struct Scan {
  TipMotion motion;
  BasePathResult base;
};

// Six seconds at an even speed round a body of that radius, outside or in it; the force goes up and down with 0.7 Hz,
// and a height of 5 um has noise of its own. The base is the circle of the mean depth, as a fit has it.
Scan round_scan(double compliance_mpN, bool outside) {
  Scan out;
  Random random(7);
  out.base.shape = PathShape::kCircle;
  const double side = outside ? 1.0 : -1.0, base_m = kRadius_m - side * compliance_mpN * 1.2;
  for (int i = 0; i < 6000; ++i) {
    const double t_s = 1e-3 * i, angle = kTurned * t_s / 6.0;
    const double force_N = 1.2 + 0.5 * std::sin(2.0 * std::numbers::pi * 0.7 * t_s);
    const Eigen::Vector3d radial(std::cos(angle), std::sin(angle), 0.0);
    const double at_m = kRadius_m - side * (compliance_mpN * force_N + 5e-6 * random.normal());
    out.motion.t_ns.push_back(1'000'000LL * i);
    out.motion.p_world_tip_m.emplace_back(at_m * radial);
    out.motion.q_world_marker.push_back(Eigen::Quaterniond::Identity());
    out.motion.force_N.push_back(force_N);
    out.base.path.p_world_m.emplace_back(base_m * radial);
    out.base.path.n_world.emplace_back(side * radial);
    out.base.path.s_m.push_back(base_m * angle);
    out.base.contact.push_back(1);
  }
  out.base.length_m = out.base.path.s_m.back();
  return out;
}

// 0.36 mm of 35: 1 %. The compliance is known to a few per cent here.
TEST(MeasureOnSurface, ASoftBodyIsAsLongAsItsSurface) {
  for (const bool outside : {true, false}) {
    Scan scan = round_scan(kCompliance_mpN, outside);
    const double tip_m = scan.base.length_m;
    measure_on_surface(scan.motion, {}, scan.base);
    ASSERT_EQ(scan.base.tip_s_m.size(), scan.base.path.size());
    EXPECT_EQ(scan.base.tip_s_m.back(), tip_m);
    EXPECT_NEAR(scan.base.indentation_m, 1.2 * kCompliance_mpN, 0.03e-3);
    EXPECT_NEAR(scan.base.length_m, kRadius_m * kTurned, 0.15e-3) << outside;
    EXPECT_NEAR(tip_m - kRadius_m * kTurned, (outside ? -1.0 : 1.0) * 0.9e-3, 0.02e-3);
    // Between springs and Hertz's ball: 0.29 of the depth at least.
    EXPECT_GT(scan.base.indentation_sigma_m, 0.28 * scan.base.indentation_m);
    EXPECT_LT(scan.base.indentation_sigma_m, 0.5 * scan.base.indentation_m);
  }
}

TEST(MeasureOnSurface, OfAHardBodyLittleChanges) {
  Scan scan = round_scan(0.002e-3, true);
  measure_on_surface(scan.motion, {}, scan.base);
  EXPECT_NEAR(scan.base.length_m, kRadius_m * kTurned, 0.05e-3);
}

// Four newtons at rest before the stroke do not lengthen it.
TEST(MeasureOnSurface, ARestDoesNotCount) {
  Scan scan = round_scan(kCompliance_mpN, true), rest = scan;
  for (std::size_t i = 0; i < 2000; ++i) {
    rest.motion.force_N[i] = 4.0;
    for (std::vector<Eigen::Vector3d>* points : {&rest.base.path.p_world_m, &rest.base.path.n_world})
      (*points)[i] = (*points)[2000];
    rest.base.path.s_m[i] = rest.base.path.s_m[2000];
    rest.motion.p_world_tip_m[i] = rest.motion.p_world_tip_m[2000].normalized() * (kRadius_m - kCompliance_mpN * 4.0);
  }
  measure_on_surface(rest.motion, {}, rest.base);
  EXPECT_LT(rest.base.indentation_m, 0.55e-3);
}

TEST(MeasureOnSurface, NothingChangesOnAPlaneOrAMeshOrWithoutAForce) {
  for (const PathShape shape : {PathShape::kPlane, PathShape::kLine, PathShape::kMesh}) {
    Scan scan = round_scan(kCompliance_mpN, true);
    scan.base.shape = shape;
    const std::vector<double> before = scan.base.path.s_m;
    measure_on_surface(scan.motion, {}, scan.base);
    EXPECT_EQ(scan.base.path.s_m, before);
    EXPECT_TRUE(scan.base.tip_s_m.empty());
  }
  Scan scan = round_scan(kCompliance_mpN, true);
  scan.motion.force_N.assign(scan.motion.size(), std::numeric_limits<double>::quiet_NaN());
  const std::vector<double> before = scan.base.path.s_m;
  measure_on_surface(scan.motion, {}, scan.base);
  EXPECT_EQ(scan.base.path.s_m, before);
  EXPECT_EQ(scan.base.indentation_m, 0.0);
}

}  // namespace
}  // namespace asperity
