#include "asperity/simulation/scan_path.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "asperity/base/error.h"
#include "asperity/simulation/base_shape.h"

namespace asperity {
namespace {

ScanPath make_path(HandConfig config) {
  Random random(5);
  return {config, random};
}

TEST(ScanPath, ItsParameterIsItsArcLength) {
  for (const HandPathShape kind : {HandPathShape::kStraight, HandPathShape::kCurved, HandPathShape::kBackAndForth}) {
    HandConfig config;
    config.path = kind;
    const ScanPath path = make_path(config);
    for (double s = -1e-3; s < path.length_m() + 1e-3; s += 0.37e-3) {
      const ScanPoint a = path.at(s - 1e-7);
      const ScanPoint b = path.at(s + 1e-7);
      const double angle = path.at(s).angle_rad;
      // Angles are linear over 50 µm; in a turn their second derivative reaches 1.3 rad/mm².
      EXPECT_NEAR((b.a_m - a.a_m) / 2e-7, std::cos(angle), 5e-4);
      EXPECT_NEAR((b.v_m - a.v_m) / 2e-7, std::sin(angle), 5e-4);
    }
  }
}

TEST(ScanPath, StraightOneIsCentred) {
  HandConfig config;
  config.lateral_wander_m = 0.0;
  const ScanPath path = make_path(config);
  EXPECT_NEAR(path.at(0.0).a_m, -0.04, 1e-9);
  EXPECT_NEAR(path.at(0.08).a_m, 0.04, 1e-9);
  EXPECT_NEAR(path.at(0.03).v_m, 0.0, 1e-12);
}

TEST(ScanPath, ArcHasItsSagitta) {
  HandConfig config;
  config.path = HandPathShape::kCurved;
  config.lateral_wander_m = 0.0;
  const ScanPath path = make_path(config);
  EXPECT_NEAR(path.at(0.04).v_m - path.at(0.0).v_m, 8e-3, 1e-8);
  EXPECT_NEAR(path.at(0.08).v_m, path.at(0.0).v_m, 1e-8);
}

TEST(ScanPath, StrokesRunToAndFroOnNeighbouringRows) {
  HandConfig config;
  config.path = HandPathShape::kBackAndForth;
  config.lateral_wander_m = 0.0;
  const ScanPath path = make_path(config);
  const double turn_m = (path.length_m() - 3 * 0.08) / 2;
  const ScanPoint first = path.at(0.04);
  const ScanPoint second = path.at(0.08 + turn_m + 0.04);
  const ScanPoint third = path.at(2 * (0.08 + turn_m) + 0.04);
  EXPECT_NEAR(second.v_m - first.v_m, 2.5e-3, 2e-6);  // Simpson's and the turn's own sums
  EXPECT_NEAR(third.v_m - second.v_m, 2.5e-3, 2e-6);
  EXPECT_NEAR(std::cos(second.angle_rad), -1.0, 1e-12);
  EXPECT_NEAR(std::cos(third.angle_rad), 1.0, 1e-12);
  EXPECT_NEAR(third.a_m, first.a_m, 2e-6);
}

TEST(ScanPath, StrokesOnOneLineAreJoinedByLoops) {
  HandConfig config;
  config.path = HandPathShape::kBackAndForth;
  config.lateral_wander_m = 0.0;
  config.row_spacing_m = 0.0;
  const ScanPath path = make_path(config);
  const double turn_m = (path.length_m() - 3 * 0.08) / 2;
  EXPECT_GT(turn_m, 1e-3);
  for (const double along_m : {0.01, 0.04, 0.07}) {
    const ScanPoint first = path.at(along_m), second = path.at(0.08 + turn_m + 0.08 - along_m);
    EXPECT_NEAR(second.v_m, first.v_m, 5e-6);  // Simpson's and the turn's own sums
    EXPECT_NEAR(second.a_m, first.a_m, 5e-6);
    EXPECT_NEAR(std::cos(second.angle_rad), -1.0, 1e-12);
  }
}

TEST(SimulatedShape, CylinderHasItsRadiusAndOutwardNormals) {
  SimulatedShapeConfig config;
  config.kind = BaseShapeKind::kCylinder;
  const SimulatedShape shape(config);
  const Eigen::Vector3d top = shape.point_m(0.0, 0.0, 0.0);
  const Eigen::Vector3d axis_point = top - 0.06 * shape.normal(0.0);
  for (double a = -0.05; a < 0.05; a += 0.01) {
    const Eigen::Vector3d p = shape.point_m(a, 0.004, 0.001);
    const Eigen::Vector3d from_axis = p - axis_point - 0.004 * shape.across(a);
    EXPECT_NEAR(from_axis.norm(), 0.061, 1e-14);
    EXPECT_NEAR((from_axis / 0.061 - shape.normal(a)).norm(), 0.0, 1e-13);
    const Eigen::Vector3d step = shape.point_m(a + 1e-6, 0.0, 0.0) - shape.point_m(a - 1e-6, 0.0, 0.0);
    EXPECT_NEAR((step / 2e-6 - shape.along(a)).norm(), 0.0, 1e-9);
  }
}

TEST(SimulatedShape, RefusesAnImpossibleFrame) {
  SimulatedShapeConfig config;
  config.normal = {0.0, 0.0, 0.0};
  EXPECT_THROW(SimulatedShape{config}, Error);
  config.normal = {1.0, 0.0, 0.0};
  EXPECT_THROW(SimulatedShape{config}, Error);
}

}  // namespace
}  // namespace asperity
