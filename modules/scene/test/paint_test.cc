#include "asperity/scene/paint.h"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "asperity/base/error.h"
#include "asperity/testkit/shape_meshes.h"

namespace asperity {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

SceneObject plane_object() {
  SceneObject object;
  object.mesh_file = "plane.obj";
  object.unit_m = 1e-3;
  const TriangleMesh mesh = testkit::plane_mesh({60.0, 40.0}, 40, 27, 0.2, 6);  // millimetres
  object.mesh.vertices = mesh.vertices_m;
  object.mesh.triangles = mesh.triangles;
  return object;
}

SceneTexture grating(int index) {
  SceneTexture texture;
  texture.index = index;
  texture.file = "grating" + std::to_string(index) + ".texture.json";
  texture.texture.model = Fourier1d{10.0, {1e-4}, {0.0}, 0.0};
  return texture;
}

TEST(Paint, LaysATextureAlongAStraightLineOfAPlaneAtItsOwnScale) {
  SceneObject object = plane_object();
  const std::vector<Vector3d> picks{{0.01, 0.015, 0.001}, {0.05, 0.025, -0.002}};
  const PaintResult result = paint(object, picks, grating(1));
  EXPECT_THAT(result.path.pick_distance_m,
              testing::ElementsAre(testing::DoubleNear(0.001, 1e-12), testing::DoubleNear(0.002, 1e-12)));
  EXPECT_NEAR(result.path.path.s_m.back(), std::hypot(0.04, 0.01), 1e-12);
  const Vector2d along = Vector2d(40.0, 10.0).normalized();
  std::size_t painted = 0;
  for (std::size_t t = 0; t < object.mesh.triangles.size(); ++t) {
    if (object.mesh.haptic[t].texture != 1) continue;
    ++painted;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector2d d = object.mesh.vertices[object.mesh.triangles[t][k]].head<2>() - Vector2d(10.0, 15.0);
      const Vector2d expected(d.dot(along), d.x() * along.y() - d.y() * along.x());
      EXPECT_LT((object.mesh.haptic[t].xy_mm[k] - expected).norm(), 1e-6);  // a nanometre
    }
  }
  EXPECT_EQ(painted, result.warp.triangles);
  EXPECT_NEAR(result.warp.stretch_max, 1.0, 1e-6);
  ASSERT_EQ(object.textures.size(), 1u);
}

TEST(Paint, PicksAtVerticesOfTrianglesThatNameAVertexTwice) {
  SceneObject object = plane_object();
  auto& triangles = object.mesh.triangles;
  const std::uint32_t first = triangles[200][0], last = triangles[1700][1];
  triangles.insert(triangles.begin(), {{first, first, triangles[200][1]}, {last, last, last}});
  const std::vector<Vector3d> picks{1e-3 * object.mesh.vertices[first], 1e-3 * object.mesh.vertices[last]};
  const PaintResult result = paint(object, picks, grating(1));
  EXPECT_NEAR(result.path.path.s_m.back(), (picks[1] - picks[0]).norm(), 1e-12);
  EXPECT_GT(result.warp.triangles, 40u);
}

TEST(Paint, ASecondStrokeCoversWhatItCrossesOnly) {
  SceneObject object = plane_object();
  const std::vector<Vector3d> across{{0.01, 0.02, 0.0}, {0.05, 0.02, 0.0}};
  const std::vector<Vector3d> up{{0.03, 0.005, 0.0}, {0.03, 0.035, 0.0}};
  paint(object, across, grating(2));
  const std::size_t before = static_cast<std::size_t>(std::count_if(
      object.mesh.haptic.begin(), object.mesh.haptic.end(), [](const HapticTriangle& h) { return h.texture == 2; }));
  const PaintResult second = paint(object, up, grating(1));
  EXPECT_GT(second.painted_over, 5u);
  const std::size_t after = static_cast<std::size_t>(std::count_if(
      object.mesh.haptic.begin(), object.mesh.haptic.end(), [](const HapticTriangle& h) { return h.texture == 2; }));
  EXPECT_EQ(before - after, second.painted_over);
  ASSERT_EQ(object.textures.size(), 2u);
  EXPECT_EQ(object.textures[0].index, 1);
  EXPECT_EQ(object.textures[1].index, 2);
}

TEST(Paint, FollowsTheSurfaceOfASphereThroughSeveralPoints) {
  SceneObject object;
  object.mesh_file = "ball.obj";
  const TriangleMesh mesh = testkit::sphere_mesh(0.03, 4);
  object.mesh.vertices = mesh.vertices_m;
  object.mesh.triangles = mesh.triangles;
  const std::vector<Vector3d> picks{{0.03, 0.0, 0.0}, {0.0, 0.03, 0.0}, {-0.03, 0.0, 0.0}};
  const PaintResult result = paint(object, picks, grating(1));
  // Half a great circle; edges of 2 mm cut off 2²/24/30² of it.
  EXPECT_NEAR(result.path.path.s_m.back(), 0.03 * std::numbers::pi, 2e-4);
  EXPECT_TRUE(result.path.locally_shortest);
  EXPECT_TRUE(result.warp.folded.empty());
  EXPECT_GT(result.warp.stretch_min, 0.9);
  EXPECT_LT(result.warp.stretch_max, 1.1);
}

TEST(Paint, RefusesWhatIsNoPath) {
  SceneObject object = plane_object();
  const std::vector<Vector3d> one{{0.01, 0.02, 0.0}};
  const std::vector<Vector3d> same{{0.01, 0.02, 0.0}, {0.01, 0.02, 0.0}};
  const std::vector<Vector3d> broken{{0.01, 0.02, 0.0}, {std::nan(""), 0.02, 0.0}};
  const std::vector<Vector3d> good{{0.01, 0.02, 0.0}, {0.03, 0.02, 0.0}};
  for (const auto& picks : {one, same, broken}) EXPECT_THROW(paint(object, picks, grating(1)), Error);
  EXPECT_THROW(paint(object, good, grating(-1)), Error);
  EXPECT_TRUE(object.textures.empty());
}

}  // namespace
}  // namespace asperity
