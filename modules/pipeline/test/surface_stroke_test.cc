#include "asperity/pipeline/surface_stroke.h"

#include <cmath>

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

TEST(SurfaceStroke, ATextureInTwoStripsHasTwoLines) {
  Scene scene = feel_test::plate(80.0);
  // Rows below 8 mm and above 12 mm, each with its own y = 0, their x apart by less than a cell.
  for (std::size_t t = 0; t < scene.objects[0].mesh.haptic.size(); ++t) {
    HapticTriangle& haptic = scene.objects[0].mesh.haptic[t];
    const double lowest_m = scene.objects[0].mesh.vertices[scene.objects[0].mesh.triangles[t][0]].y();
    if (lowest_m > 7e-3 && lowest_m < 11e-3) haptic.texture = -1;
    for (Eigen::Vector2d& xy_mm : haptic.xy_mm)
      xy_mm += lowest_m < 9e-3 ? Eigen::Vector2d(0, 6) : Eigen::Vector2d(0.7, -6);
  }
  EXPECT_NEAR(textured_line(scene).s_m.back(), 80e-3, 1e-9);
}

TEST(SurfaceStroke, OnePressServesTheFaceThatTheMiddleLiesOn) {
  // A roof: the plate, from x = 50 mm on, folded down by 70 degrees.
  Scene scene = feel_test::plate(80.0);
  for (Eigen::Vector3d& v : scene.objects[0].mesh.vertices) {
    const double beyond_m = v.x() - 50e-3;
    if (beyond_m > 1e-9) v = {50e-3 + 0.342 * beyond_m, v.y(), -0.940 * beyond_m};
  }
  const SurfaceLine line = textured_line(scene);
  EXPECT_NEAR(line.s_m.back(), 80e-3, 0.1e-3);
  EXPECT_NEAR(facing_part(line).s_m.back(), 50e-3, 0.1e-3);
  EXPECT_THROW(line_across(Scene{}, 0.1), Error);
  EXPECT_EQ(textured_line(Scene{}).size(), 0u);
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
