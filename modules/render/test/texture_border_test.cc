// Where textures fade, and what it costs to find that out.
#include <chrono>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "asperity/scene/lay_texture.h"
#include "asperity/testkit/shape_meshes.h"
#include "evaluate_contacts.h"
#include "scenes.h"

namespace asperity {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using testing_render::at;
using testing_render::scene_of;
using testing_render::stroke;

constexpr double kWave_mm = 5.0;

SceneTexture wave() {
  SceneTexture laid;
  laid.index = 1;
  laid.texture.model = Fourier1d{kWave_mm, {1e-4}, {0.0}, 0.0};
  return laid;
}

// All triangles textured, x and y those of the mesh.
Scene textured(const TriangleMesh& mesh) {
  Scene scene = scene_of(mesh);
  scene.objects[0].textures.push_back(wave());
  for (const Triangle& t : mesh.triangles) {
    HapticTriangle haptic;
    haptic.texture = 1;
    for (std::size_t k = 0; k < 3; ++k) haptic.xy_mm[k] = 1e3 * mesh.vertices_m[t[k]].head<2>();
    scene.objects[0].mesh.haptic.push_back(haptic);
  }
  return scene;
}

double smooth(double t) { return t * t * (3.0 - 2.0 * t); }

// A scene file whose unit is wrong by a thousand: every edge is within the fade of every triangle. Each with each would
// be 6e8 distances, a minute.
TEST(TextureBorder, IsMadeSoonHoweverWideTheFade) {
  Scene scene = textured(testkit::plane_mesh({0.1, 0.1}, 100, 100));
  auto& haptic = scene.objects[0].mesh.haptic;
  for (std::size_t t = 1; t < haptic.size(); t += 2) haptic[t].texture = -1;
  scene.objects[0].unit_m = 1e-6;
  const auto start = std::chrono::steady_clock::now();
  make_render_model(scene, {});
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 10.0);
}

// Two long triangles, textured, beside a row of 400 small ones, textured, beside bare ones: 400 edges of the border lie
// 0.3 mm from the long ones.
TEST(TextureBorder, FadesALongTriangleAtItsEndsToo) {
  constexpr int kCells = 400;
  constexpr double kLength_m = 0.1;
  TriangleMesh mesh;
  for (const double y_m : {0.0, 0.5e-3, 0.8e-3})
    for (int i = 0; i <= kCells; ++i) mesh.vertices_m.emplace_back(kLength_m * i / kCells, y_m, 0.0);
  const auto vertex = [](int row, int i) { return static_cast<std::uint32_t>(row * (kCells + 1) + i); };
  for (int row = 0; row < 2; ++row) {
    for (int i = 0; i < kCells; ++i) {
      mesh.triangles.push_back({vertex(row, i), vertex(row, i + 1), vertex(row + 1, i + 1)});
      mesh.triangles.push_back({vertex(row, i), vertex(row + 1, i + 1), vertex(row + 1, i)});
    }
  }
  const auto far = static_cast<std::uint32_t>(mesh.vertices_m.size());
  mesh.vertices_m.emplace_back(0.0, 2e-3, 0.0);
  mesh.vertices_m.emplace_back(kLength_m, 2e-3, 0.0);
  const auto first = static_cast<std::uint32_t>(mesh.triangles.size());
  mesh.triangles.push_back({vertex(2, 0), vertex(2, kCells), far + 1});
  mesh.triangles.push_back({vertex(2, 0), far + 1, far});
  Scene scene = textured(mesh);
  for (std::size_t t = 0; t < 2 * kCells; ++t) scene.objects[0].mesh.haptic[t].texture = -1;
  const RenderModel model = make_render_model(scene, {});
  for (const double part : {0.01, 0.5, 0.99}) {
    const TexturePlace place = texture_place(model, model.objects[0], first, Vector3d(1.0 - part, part, 0.0));
    EXPECT_NEAR(place.fade, smooth(0.3), 1e-6) << part;
  }
}

// A plane whose right half has coordinates that are `shift` further along.
RenderModel torn(const Vector2d& shift_mm, const TriangleMesh& mesh) {
  Scene scene = textured(mesh);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    double middle_m = 0.0;
    for (const std::uint32_t v : mesh.triangles[t]) middle_m += mesh.vertices_m[v].x() / 3.0;
    if (middle_m < 0.05) continue;
    for (Vector2d& xy_mm : scene.objects[0].mesh.haptic[t].xy_mm) xy_mm += shift_mm;
  }
  return make_render_model(scene, {});
}

TEST(TextureBorder, IsWhereCoordinatesTear) {
  const RenderModel model = torn({1.7, 0.0}, testkit::plane_mesh({0.1, 0.1}, 40, 40));
  ServoState state;
  constexpr double kStep_m = 1e-6;
  stroke(model, state, {0.047, 0.051, 1e-3}, {0.047, 0.051, -1e-3}, 1e-5);
  Vector3d before_N = render_step(model, state, at({0.047, 0.051, -1e-3})).texture_N;
  double least_N = before_N.norm();
  for (int k = 1; k < 6000; ++k) {
    const Vector3d f_N = render_step(model, state, at({0.047 + kStep_m * k, 0.051, -1e-3})).texture_N;
    // 0.2 mm over a fade of 1 mm and the wave's own slope, at 1 N/mm.
    ASSERT_LT((f_N - before_N).norm(), 1.05e3 * (0.3 + 0.13) * kStep_m) << k;
    before_N = f_N;
    least_N = std::min(least_N, f_N.norm());
  }
  EXPECT_LT(least_N, 1e-6);
}

TEST(TextureBorder, IsNotWhereTheyDifferByWholePeriodsOrBesideTheHeights) {
  const TriangleMesh mesh = testkit::plane_mesh({0.1, 0.1}, 40, 40);
  EXPECT_FALSE(torn({3.0 * kWave_mm * (1.0 + 1e-9), 0.0}, mesh).objects[0].border.edges);
  EXPECT_FALSE(torn({0.0, 0.7}, mesh).objects[0].border.edges) << "a model of x alone";
  EXPECT_TRUE(torn({0.1, 0.0}, mesh).objects[0].border.edges);
}

// A second texture, a twentieth as high, over the right two thirds of a plane or under the first: where both are, the
// one of the greater order is rendered alone, and the force is continuous from one to the other.
TEST(TextureBorder, OfTwoTexturesTheOneOfTheGreaterOrderIsRendered) {
  const TriangleMesh mesh = testkit::plane_mesh({0.1, 0.1}, 40, 40);
  const auto model_with = [&](LayAt at) {
    Scene scene = textured(mesh);
    SceneObject& object = scene.objects[0];
    SceneTexture second = wave();
    second.index = 2;
    second.file = "second.texture.json";
    second.order = further_order(object, at);
    second.texture.model = Fourier1d{kWave_mm, {5e-6}, {0.0}, 0.0};
    std::vector<CoveredTriangle> claims;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      const double x_m = mesh.vertices_m[mesh.triangles[t][0]].x();
      if (x_m < 0.034) continue;
      claims.push_back({t, object.mesh.haptic[t]});
      claims.back().haptic.texture = 2;
    }
    put_texture(object, second);
    lay_triangles(object, claims);
    return make_render_model(scene, {});
  };
  const auto strongest = [](const RenderModel& model, double from_m, double to_m) {
    ServoState state;
    stroke(model, state, {from_m, 0.051, 1e-3}, {from_m, 0.051, -1e-3}, 1e-5);
    constexpr double kStep_m = 2e-6;
    double most_N = 0.0;
    Vector3d before_N = render_step(model, state, at({from_m, 0.051, -1e-3})).texture_N;
    for (double x_m = from_m; x_m < to_m; x_m += kStep_m) {
      const Vector3d f_N = render_step(model, state, at({x_m, 0.051, -1e-3})).texture_N;
      EXPECT_LT((f_N - before_N).norm(), 1.05e3 * (0.3 + 0.13) * kStep_m) << x_m;
      before_N = f_N;
      most_N = std::max(most_N, f_N.norm());
    }
    return most_N;
  };
  const RenderModel over = model_with(LayAt::kOver), under = model_with(LayAt::kUnder);
  // Of the second texture alone at most 10 µm at 1 N/mm; of the first 0.2 mm.
  EXPECT_LT(strongest(over, 0.05, 0.07), 0.02);
  EXPECT_GT(strongest(over, 0.02, 0.05), 0.1);
  EXPECT_GT(strongest(under, 0.05, 0.07), 0.1);
  EXPECT_TRUE(over.objects[0].border.edges);
  EXPECT_FALSE(under.objects[0].border.edges) << "what is below has no border";
}

}  // namespace
}  // namespace asperity
