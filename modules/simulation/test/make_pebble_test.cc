#include "asperity/simulation/make_pebble.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include <Eigen/Geometry>

#include "asperity/base/error.h"
#include "asperity/simulation/random_motion.h"
#include "asperity/simulation/randomise_pose.h"

namespace asperity {
namespace {

using Eigen::Vector3d;

TEST(Pebble, IsClosedAndOutward) {
  const TriangleMesh mesh = make_pebble();
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> directed;
  double volume_m3 = 0.0, edges_m = 0.0;
  for (const Triangle& t : mesh.triangles) {
    const Vector3d &a = mesh.vertices_m[t[0]], &b = mesh.vertices_m[t[1]], &c = mesh.vertices_m[t[2]];
    volume_m3 += a.dot(b.cross(c)) / 6.0;
    for (std::size_t k = 0; k < 3; ++k) {
      ++directed[{t[k], t[(k + 1) % 3]}];
      edges_m += (mesh.vertices_m[t[k]] - mesh.vertices_m[t[(k + 1) % 3]]).norm();
    }
  }
  // Each edge is gone along once in either direction, and Euler's formula holds for a sphere.
  for (const auto& [edge, count] : directed) {
    ASSERT_EQ(count, 1);
    ASSERT_TRUE(directed.contains({edge.second, edge.first}));
  }
  EXPECT_EQ(mesh.vertices_m.size() + mesh.triangles.size(), directed.size() / 2 + 2);
  // The ellipsoid's volume; bumps of 1.2 mm, of which the mean over few waves need not vanish.
  EXPECT_NEAR(volume_m3, 4.0 / 3.0 * std::numbers::pi * 0.045 * 0.036 * 0.028, 0.06 * volume_m3);
  EXPECT_NEAR(edges_m / static_cast<double>(directed.size()), 1.5e-3, 0.1e-3);
}

TEST(Pebble, BumpsHaveTheirHeight) {
  PebbleConfig config;
  config.facet_m = 4e-3;
  double sum_m2 = 0.0;
  std::size_t count = 0;
  for (config.seed = 1; config.seed <= 20; ++config.seed) {
    const TriangleMesh bumpy = make_pebble(config);
    PebbleConfig smooth = config;
    smooth.bump_m = 0.0;
    const TriangleMesh even = make_pebble(smooth);
    for (std::size_t i = 0; i < even.vertices_m.size(); ++i) {
      sum_m2 += (bumpy.vertices_m[i] - even.vertices_m[i]).squaredNorm();
      ++count;
    }
    // The smooth one is the ellipsoid itself.
    const Vector3d on_sphere = even.vertices_m[7].cwiseQuotient(Vector3d(0.045, 0.036, 0.028));
    EXPECT_NEAR(on_sphere.norm(), 1.0, 1e-12);
  }
  EXPECT_NEAR(std::sqrt(sum_m2 / static_cast<double>(count)), 1.2e-3, 0.12e-3);  // 20 draws of 24 waves
}

TEST(Pebble, TheSeedDecides) {
  PebbleConfig config;
  config.facet_m = 10e-3;
  EXPECT_EQ(make_pebble(config).vertices_m, make_pebble(config).vertices_m);
  const auto before = make_pebble(config).vertices_m;
  config.seed = 2;
  EXPECT_NE(make_pebble(config).vertices_m, before);
}

TEST(Pebble, WhatCannotBeIsRefused) {
  PebbleConfig config;
  config.bump_m = 3e-3;
  EXPECT_THROW(make_pebble(config), Error);
  config = {};
  config.facet_m = 1e-5;
  EXPECT_THROW(make_pebble(config), Error);
}

TEST(PlaceAtRandom, StaysBeforeTheTracker) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const SimulatedShapeConfig before;
    SimulatedShapeConfig shape;
    randomise_pose(seed, shape);
    const Vector3d n0(before.normal[0], before.normal[1], before.normal[2]);
    const Vector3d n(shape.normal[0], shape.normal[1], shape.normal[2]);
    const Vector3d along(shape.stroke_direction[0], shape.stroke_direction[1], shape.stroke_direction[2]);
    EXPECT_GE(n.dot(n0.normalized()), std::cos(20.001 * std::numbers::pi / 180.0));
    EXPECT_NEAR(along.dot(n), 0.0, 1e-9);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_LE(std::abs(shape.centre_m[i] - before.centre_m[i]), 0.03);
  }
}

TEST(RandomMotion, ShiftsTheCentreAndTurnsAboutIt) {
  const Vector3d centre_m(0.1, -0.2, 0.3);
  const Pose motion = random_motion(5e-3, 0.1, centre_m, 3);
  EXPECT_NEAR((motion * centre_m - centre_m).norm(), 5e-3, 1e-15);
  EXPECT_NEAR(log_rotation(motion.rotation).norm(), 0.1, 1e-12);
  EXPECT_EQ(motion.translation_m, random_motion(5e-3, 0.1, centre_m, 3).translation_m);
  EXPECT_NE(motion.translation_m, random_motion(5e-3, 0.1, centre_m, 4).translation_m);
}

}  // namespace
}  // namespace asperity
