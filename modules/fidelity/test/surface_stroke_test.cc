#include "asperity/fidelity/surface_stroke.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "asperity/base/error.h"
#include "feel_test_scene.h"

namespace asperity {
namespace {

constexpr double kRounding_m = 1e-12;
constexpr double kBeside_m = 0.03e-3;  // the line keeps a thousandth of the texture's width from its middle

TEST(SurfaceStroke, FollowsTheMiddleOfTheTexture) {
  Scene scene = feel_test::plate(80.0);
  scene.objects[0].T_world_mesh = {Eigen::Quaterniond(Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitX())), {0.1, 0, 0}};
  const SurfaceLine line = textured_line(scene);
  ASSERT_GT(line.size(), 2u);
  EXPECT_NEAR(line.s_m.back(), 80e-3, kRounding_m);
  const Pose T_mesh_world = scene.objects[0].T_world_mesh.inverse();
  for (std::size_t i = 0; i < line.size(); ++i) {
    const Eigen::Vector3d p_mesh_m = T_mesh_world * line.p_world_m[i];
    EXPECT_NEAR(p_mesh_m.x(), line.s_m[i], kRounding_m);
    EXPECT_NEAR(p_mesh_m.y(), 10e-3, kBeside_m);
    EXPECT_NEAR(p_mesh_m.z(), 0.0, kRounding_m);
    EXPECT_NEAR((T_mesh_world.rotation * line.n_world[i]).z(), 1.0, 1e-12);
  }
}

TEST(SurfaceStroke, TheLongestPieceOfATornTextureIsTaken) {
  Scene scene = feel_test::plate(80.0);
  // Without the cells from 20 to 26 mm.
  for (std::size_t t = 0; t < scene.objects[0].mesh.haptic.size(); ++t) {
    const double x_m = scene.objects[0].mesh.vertices[scene.objects[0].mesh.triangles[t][0]].x();
    if (x_m > 19e-3 && x_m < 25e-3) scene.objects[0].mesh.haptic[t].texture = -1;
  }
  const SurfaceLine line = textured_line(scene);
  EXPECT_NEAR(line.p_world_m.front().x(), 26e-3, kRounding_m);
  EXPECT_NEAR(line.p_world_m.back().x(), 80e-3, kRounding_m);
}

TEST(SurfaceStroke, WithoutTexturesTheLongestAxisIsCrossed) {
  Scene scene = feel_test::plate(80.0);
  scene.objects[0].mesh.haptic.clear();
  EXPECT_EQ(textured_line(scene).size(), 0u);
  const SurfaceLine line = line_across(scene, 50e-3);
  EXPECT_NEAR(line.s_m.back(), 50e-3, 1e-9);
  EXPECT_NEAR(line.p_world_m.front().x(), 15e-3, 1e-9);
  EXPECT_NEAR(line.p_world_m.back().y(), 10e-3, 1e-9);
}

TEST(SurfaceStroke, EachOfSeveralStrokesOfATextureIsWhole) {
  // The plate's upper half is a second strip whose coordinates run as the lower one's, but 0.7 mm on.
  Scene scene = feel_test::plate(80.0);
  MeshFile& mesh = scene.objects[0].mesh;
  for (std::size_t t = 0; t < mesh.haptic.size(); ++t) {
    const Triangle& corners = mesh.triangles[t];
    double highest_m = 0.0;
    for (const std::uint32_t v : corners) highest_m = std::max(highest_m, mesh.vertices[v].y());
    const bool upper = highest_m > 11e-3;
    for (Eigen::Vector2d& xy_mm : mesh.haptic[t].xy_mm) {
      xy_mm += upper ? Eigen::Vector2d(0.7, -5.0) : Eigen::Vector2d(0.0, 5.0);
    }
  }
  const SurfaceLine line = textured_line(scene);
  ASSERT_GT(line.size(), 1u);
  EXPECT_NEAR(line.s_m.back(), 80e-3, kRounding_m);
  EXPECT_FALSE(line.turns_away);
}

// A closed box about the origin, two triangles a face.
Scene box(double x_m, double y_m, double z_m) {
  SceneObject object;
  for (int i = 0; i < 8; ++i) {
    object.mesh.vertices.emplace_back((i & 4) != 0 ? x_m : -x_m, (i & 2) != 0 ? y_m : -y_m, (i & 1) != 0 ? z_m : -z_m);
  }
  object.mesh.triangles = {{0, 1, 3}, {0, 3, 2}, {4, 6, 7}, {4, 7, 5}, {0, 4, 5}, {0, 5, 1},
                           {2, 3, 7}, {2, 7, 6}, {0, 2, 6}, {0, 6, 4}, {1, 5, 7}, {1, 7, 3}};
  Scene scene;
  scene.objects.push_back(std::move(object));
  return scene;
}

TEST(SurfaceStroke, EndsWhereTheSurfaceTurnsAway) {
  for (const auto& [x_m, y_m, z_m] : {std::array{20e-3, 20e-3, 20e-3}, std::array{30e-3, 20e-3, 10e-3},
                                      std::array{10e-3, 10e-3, 30e-3}, std::array{20e-3, 20e-3, 20.0000001e-3}}) {
    const SurfaceLine line = line_across(box(x_m, y_m, z_m), 80e-3);
    ASSERT_GT(line.size(), 1u);
    EXPECT_NEAR(line.s_m.back(), 2.0 * std::max({x_m, y_m, z_m}), kRounding_m);
    EXPECT_TRUE(line.turns_away);
    for (const Eigen::Vector3d& n : line.n_world) EXPECT_NEAR(n.dot(line.n_world.front()), 1.0, 1e-12);
    EXPECT_LT(steepest_rad(line), 1e-6);
  }
  const SurfaceLine whole = line_across(box(50e-3, 30e-3, 5e-3), 80e-3);
  EXPECT_NEAR(whole.s_m.back(), 80e-3, kRounding_m);
  EXPECT_FALSE(whole.turns_away);
}

TEST(SurfaceStroke, EndsOnARoundObjectAtSixtyDegrees) {
  // A cylinder of 20 mm radius about y in facets of 3 degrees, textured all round.
  constexpr double kRadius_m = 20e-3, kHalf_m = 10e-3;
  constexpr std::uint32_t kFacets = 120;
  Scene scene = feel_test::plate(80.0);
  MeshFile& mesh = scene.objects[0].mesh;
  mesh = {};
  for (std::uint32_t i = 0; i < kFacets; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kFacets;
    for (const double y_m : {-kHalf_m, kHalf_m}) {
      mesh.vertices.emplace_back(kRadius_m * std::sin(angle), y_m, kRadius_m * std::cos(angle));
    }
  }
  const double facet_mm = 2e3 * std::numbers::pi * kRadius_m / kFacets;
  for (std::uint32_t i = 0; i < kFacets; ++i) {
    const std::uint32_t a = 2 * i, next = 2 * ((i + 1) % kFacets);
    const Eigen::Vector2d low(facet_mm * i, -1e3 * kHalf_m), high(facet_mm * i, 1e3 * kHalf_m), on(facet_mm, 0.0);
    mesh.triangles.push_back({a, next, next + 1});
    mesh.triangles.push_back({a, next + 1, a + 1});
    HapticTriangle first, second;
    first.texture = second.texture = 1;
    first.xy_mm = {low, low + on, high + on};
    second.xy_mm = {low, high + on, high};
    mesh.haptic.push_back(first);
    mesh.haptic.push_back(second);
  }
  const SurfaceLine line = textured_line(scene);
  ASSERT_GT(line.size(), 1u);
  const double wanted_m = 2.0 * std::numbers::pi / 3.0 * kRadius_m, facet_m = 1e-3 * facet_mm;
  EXPECT_NEAR(line.s_m.back(), wanted_m, 2.0 * facet_m) << "120 degrees in all";
  EXPECT_TRUE(line.turns_away);
  EXPECT_LT(steepest_rad(line), std::numbers::pi / 180.0 * 65.0);
}

TEST(SurfaceStroke, ASceneWithoutObjectsIsRefused) {
  EXPECT_EQ(textured_line({}).size(), 0u);
  EXPECT_THROW(line_across({}, 80e-3), Error);
  EXPECT_THROW(line_between({}, Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX()), Error);
}

TEST(SurfaceStroke, GoesToAndFroAtItsSpeed) {
  const SurfaceLine line = shortened(textured_line(feel_test::plate(80.0)), 10e-3);
  EXPECT_NEAR(line.s_m.back(), 60e-3, kRounding_m);
  SurfaceStrokeConfig config;
  config.speed_mps = 0.06;
  const HandStroke stroke = stroke_along(line, 0.0, config);
  // Twice 0.2 s to come down and press, then two legs of 60 mm / 60 mm/s and 0.1 s each.
  constexpr double kWhole_s = 0.4 + 2.0 * 1.1, kStep_s = 1e-3;
  EXPECT_NEAR(1e-9 * static_cast<double>(stroke.path.t_ns.back()), kWhole_s, kStep_s);
  EXPECT_NEAR(stroke.press_direction_world.z(), -1.0, 1e-12);
  const auto at = [&](double t_s) { return static_cast<std::size_t>(std::lround(t_s / kStep_s)); };
  EXPECT_NEAR(stroke.path.p_world_m[0].z(), 2e-3, kRounding_m);
  EXPECT_NEAR(stroke.press_N[at(0.2)], 0.0, 1e-12);
  EXPECT_NEAR(stroke.press_N[at(0.4)], 1.0, 1e-12);
  EXPECT_NEAR(stroke.path.p_world_m[at(0.4)].x(), 10e-3, kRounding_m);
  EXPECT_NEAR(stroke.path.p_world_m[at(0.4 + 0.55)].x(), 40e-3, kRounding_m) << "half way";
  EXPECT_NEAR(stroke.path.p_world_m[at(0.4 + 1.1)].x(), 70e-3, kRounding_m) << "the turn";
  EXPECT_NEAR(stroke.path.p_world_m[at(0.4 + 2.2)].x(), 10e-3, 1e-6);
  for (std::size_t i = 1; i < stroke.path.size(); ++i) {
    EXPECT_LT((stroke.path.p_world_m[i] - stroke.path.p_world_m[i - 1]).head<2>().norm(), 0.06 * kStep_s * 1.001);
  }
  EXPECT_THROW(stroke_along(SurfaceLine{}, 0.0, config), Error);
}

TEST(SurfaceStroke, ATimeIsFoundInItsInterval) {
  const std::vector<std::int64_t> times{0, 10, 30};
  std::size_t hint = 2;
  EXPECT_EQ(find_time(times, 10, hint).index, 1u);
  EXPECT_EQ(find_time(times, 10, hint).share, 0.0);
  EXPECT_EQ(find_time(times, 25, hint).share, 0.75);
  EXPECT_EQ(find_time(times, 5, hint).index, 0u);
  EXPECT_EQ(find_time(times, 99, hint).index, 2u);
  EXPECT_EQ(find_time(times, -1, hint).share, 0.0);
}

}  // namespace
}  // namespace asperity
