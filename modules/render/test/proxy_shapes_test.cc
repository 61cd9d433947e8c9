#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "asperity/geometry/mesh_bvh.h"
#include "asperity/testkit/count_allocations.h"
#include "asperity/testkit/shape_meshes.h"
#include "scenes.h"

namespace asperity {
namespace {

using Eigen::Vector3d;
using testing_render::at;
using testing_render::bumpy_sphere;
using testing_render::object_of;
using testing_render::scene_of;
using testing_render::stroke;

constexpr double kStiffness = 1000.0;  // N/m, the config's
constexpr double kRounding_N = 1e-9;

// Two half planes through the y axis that rise by `slope` (tangent) on both sides of it; negative: a roof.
TriangleMesh wedge(double slope) {
  const double w = 0.05, z = slope * w;
  TriangleMesh mesh;
  mesh.vertices_m = {{0, -w, 0}, {0, w, 0}, {w, -w, z}, {w, w, z}, {-w, -w, z}, {-w, w, z}};
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {0, 1, 5}, {0, 5, 4}};
  return mesh;
}

TEST(ProxyShapes, ConcaveWedgeHoldsTheTipInItsCorner) {
  for (const double slope : {0.01, 0.3, 1.0, 3.0}) {
    for (const double tip_m : {0.0, 1e-3}) {
      RenderConfig config;
      config.tip_radius_m = tip_m;
      const RenderModel model = make_render_model(scene_of(wedge(slope)), config);
      const double corner_m = tip_m * std::sqrt(1.0 + slope * slope);  // height of a ball's centre in the groove
      ServoState state;
      stroke(model, state, {5e-3, 1e-3, 0.03}, {5e-3, 1e-3, 5e-3 * slope + corner_m - 1e-3}, 1e-4);
      const Vector3d goal(0.1e-3 * slope, 2e-3, corner_m - 1e-3);
      const ServoOutput out = stroke(model, state, {5e-3, 1e-3, 5e-3 * slope + corner_m - 1e-3}, goal, 1e-4);
      EXPECT_NEAR((out.proxy_m - Vector3d(0.0, 2e-3, corner_m)).norm(), 0.0, 1e-11) << slope << ' ' << tip_m;
      EXPECT_NEAR((out.force_N - kStiffness * (Vector3d(0.0, 2e-3, corner_m) - goal)).norm(), 0.0, kRounding_N);
    }
  }
}

TEST(ProxyShapes, ConvexRoofIsCrossedAndTheNearerSidePushes) {
  // Below a steeper roof the side that the tip came by keeps a local minimum, and the tip rightly stays there.
  for (const double slope : {-0.02, -0.2, -0.5}) {
    const RenderModel model = make_render_model(scene_of(wedge(slope)), {});
    ServoState state;
    const Vector3d up = Vector3d(-slope, 0.0, 1.0).normalized();  // of the side x > 0
    stroke(model, state, {-4e-3, 0, 0.02}, {-4e-3, 0, 4e-3 * slope - 0.2e-3}, 1e-4);
    for (int k = 0; k <= 200; ++k) {
      const double x = -4e-3 + 4e-5 * k;
      const Vector3d p(x, 1e-4 * k * 0.1, slope * std::abs(x) - 0.2e-3);
      const ServoOutput out = render_step(model, state, at(p));
      const double depth_m = 0.2e-3 / std::sqrt(1.0 + slope * slope);
      if (std::abs(x) < 0.3e-3) continue;  // either side may push near the ridge
      const Vector3d n(x < 0.0 ? -up.x() : up.x(), 0.0, up.z());
      ASSERT_NEAR((out.force_N - kStiffness * depth_m * n).norm(), 0.0, kRounding_N) << slope << ' ' << x;
    }
  }
}

TEST(ProxyShapes, CylinderPushesAlongItsRadius) {
  const double radius_m = 0.02;
  const TriangleMesh mesh = testkit::cylinder_mesh(radius_m, 0.1, 400, 20, 2.0 * std::numbers::pi);
  for (const double tip_m : {0.0, 1e-3}) {
    RenderConfig config;
    config.tip_radius_m = tip_m;
    const RenderModel model = make_render_model(scene_of(mesh), config);
    const double sagitta_m = radius_m * (1.0 - std::cos(std::numbers::pi / 400));
    ServoState state;
    const auto place = [&](double depth_m, int k) {
      const double a = 0.3 + 2e-3 * k;
      return Vector3d((radius_m + tip_m - depth_m) * std::cos(a), (radius_m + tip_m - depth_m) * std::sin(a),
                      0.03 + 1e-5 * k);
    };
    stroke(model, state, place(-0.01, 0), place(1e-3, 0), 1e-4);
    for (int k = 0; k < 1000; ++k) {
      const Vector3d p = place(1e-3, k);
      const ServoOutput out = render_step(model, state, at(p));
      const Vector3d radial = Vector3d(p.x(), p.y(), 0.0).normalized();
      ASSERT_NEAR(out.force_N.norm(), kStiffness * 1e-3, kStiffness * sagitta_m * 2.3 + kRounding_N) << k;
      ASSERT_GT(out.force_N.normalized().dot(radial), std::cos(1.5 * std::numbers::pi / 400))
          << k;  // facets are uneven
    }
  }
}

TEST(ProxyShapes, ASheetHoldsFromBothSides) {
  const RenderModel model = make_render_model(scene_of(testkit::plane_mesh({0.1, 0.1}, 20, 20, 0.2)), {});
  for (const double side : {1.0, -1.0}) {
    ServoState state;
    stroke(model, state, {0.05, 0.05, side * 5e-3}, {0.05, 0.05, -side * 2e-3}, 1e-4);
    const ServoOutput out = stroke(model, state, {0.05, 0.05, -side * 2e-3}, {0.07, 0.03, -side * 2e-3}, 1e-4);
    EXPECT_NEAR((out.force_N - Vector3d(0, 0, side * 2.0)).norm(), 0.0, kRounding_N);
  }
}

TEST(ProxyShapes, ThreeSheetsOnOneEdgeMakeACornerOfTwo) {
  TriangleMesh mesh = wedge(0.0);  // z = 0, and a wall on the y axis: an edge of four triangles
  mesh.vertices_m.push_back({0, -0.05, 0.05});
  mesh.vertices_m.push_back({0, 0.05, 0.05});
  mesh.triangles.push_back({0, 1, 7});
  mesh.triangles.push_back({0, 7, 6});
  const RenderModel model = make_render_model(scene_of(mesh), {});
  ServoState state;
  stroke(model, state, {0.01, 0, 0.01}, {0.01, 0, -1e-3}, 1e-4);
  const ServoOutput out = stroke(model, state, {0.01, 0, -1e-3}, {-2e-3, 5e-3, -1e-3}, 1e-4);
  EXPECT_NEAR((out.proxy_m - Vector3d(0, 5e-3, 0)).norm(), 0.0, 1e-11);
  EXPECT_NEAR((out.force_N - Vector3d(2.0, 0, 1.0)).norm(), 0.0, kRounding_N);
}

TEST(ProxyShapes, TwoObjectsMakeOneCorner) {
  // A box that stands on a plane: the tip is held by both, each with its own stiffness.
  Scene scene = scene_of(testkit::plane_mesh({0.1, 0.1}, 20, 20));
  Pose T_world_box;
  T_world_box.translation_m = Vector3d(0.05, 0.02, 0.0);
  scene.objects.push_back(object_of(testkit::box_mesh({0.03, 0.03, 0.03}, 6), T_world_box));
  scene.objects[1].material.vertices.resize(scene.objects[1].mesh.vertices.size());
  for (Material& material : scene.objects[1].material.vertices) material.stiffness_N_per_m = 500.0;
  RenderConfig config;
  config.tip_radius_m = 1e-3;
  const RenderModel model = make_render_model(scene, config);
  ServoState state;
  stroke(model, state, {0.02, 0.035, 0.01}, {0.02, 0.035, 0.0}, 1e-4);
  const ServoOutput out = stroke(model, state, {0.02, 0.035, 0.0}, {0.051, 0.03, 0.0}, 1e-4);
  EXPECT_NEAR((out.proxy_m - Vector3d(0.049, 0.03, 1e-3)).norm(), 0.0, 1e-11);
  EXPECT_NEAR((out.force_N - Vector3d(-1.0, 0.0, 1.0)).norm(), 0.0, kRounding_N);
}

TEST(ProxyShapes, ATeleportIsSweptAndStopsAtTheSurface) {
  const RenderModel model = make_render_model(scene_of(bumpy_sphere(0.05, 20, 0.01)), {});
  ServoState state;
  ServoOutput out;
  render_step(model, state, at({0.2, 0.01, 0.02}));
  for (int k = 0; k < 50; ++k) out = render_step(model, state, at({-0.2, -0.01, -0.02}));
  EXPECT_GT(state.proxy.p_world_m.norm(), 0.045);  // it went round or stopped, but not through
}

// The proxy never overlaps the mesh, lags by no more than the slope explains, and moves whenever the hand does.
TEST(ProxyShapes, ABumpySphereIsFollowedWithoutASlip) {
  const TriangleMesh mesh = bumpy_sphere(0.05, 30, 0.02);
  for (const double tip_m : {0.0, 0.5e-3, 2e-3}) {
    for (const double friction : {0.0, 0.4}) {
      for (const double speed_mps : {0.02, 0.1}) {
        RenderConfig config;
        config.tip_radius_m = tip_m;
        config.friction = friction;
        const RenderModel model = make_render_model(scene_of(mesh), config);
        const MeshBvh bvh(mesh);
        ServoState state;
        ServoOutput before;
        for (int k = 0; k < 2500; ++k) {
          const double s = speed_mps * 1e-3 * k / 0.05;
          const double polar = 1.4 + 0.6 * std::sin(0.31 * s), around = 0.95 * s;
          const Vector3d d(std::sin(polar) * std::cos(around), std::sin(polar) * std::sin(around), std::cos(polar));
          const double top_m = bvh.cast_ray(Vector3d::Zero(), d).t;
          const double depth_m = std::min(1e-3, -1e-3 + 2e-5 * k);
          const ServoOutput out = render_step(model, state, at((top_m + tip_m - depth_m) * d));
          const Vector3d& proxy_m = state.proxy.p_world_m;
          ASSERT_GE(bvh.closest_point(proxy_m).distance_m, tip_m) << k;
          ASSERT_GT(proxy_m.norm(), bvh.cast_ray(Vector3d::Zero(), proxy_m.normalized()).t) << k;
          ASSERT_LT((out.proxy_m - (top_m + tip_m - depth_m) * d).norm(), 2e-3) << k;
          // In a pit of three facets it does rest while the hand moves.
          if (k > 200 && !out.sticking && state.proxy.touch_count < 3) {
            ASSERT_GT((out.proxy_m - before.proxy_m).norm(), 0.0) << k;
          }
          before = out;
        }
      }
    }
  }
}

TEST(ProxyShapes, AScaledSceneGivesTheSameBits) {
  const TriangleMesh mesh = bumpy_sphere(0.05, 20, 0.02);
  for (const double scale : {0x1p-10, 0x1p7}) {
    TriangleMesh scaled = mesh;
    for (Vector3d& v : scaled.vertices_m) v *= scale;
    RenderConfig config, scaled_config;
    config.tip_radius_m = 0.5e-3;
    config.friction = scaled_config.friction = 0.3;
    scaled_config.tip_radius_m = scale * config.tip_radius_m;
    const RenderModel model = make_render_model(scene_of(mesh), config);
    const RenderModel scaled_model = make_render_model(scene_of(scaled), scaled_config);
    ServoState state, scaled_state;
    for (int k = 0; k < 2000; ++k) {
      const Vector3d p = Vector3d(std::cos(2e-3 * k), std::sin(2e-3 * k), 0.4 * std::sin(1e-3 * k)).normalized() *
                         (0.0505 - std::min(0.0, 0.003 - 1e-5 * k) * -1.0);
      const ServoOutput out = render_step(model, state, at(p));
      const ServoOutput other = render_step(scaled_model, scaled_state, at(scale * p));
      ASSERT_EQ(other.force_N, scale * out.force_N) << k;
      ASSERT_EQ(other.proxy_m, scale * out.proxy_m) << k;
    }
  }
}

TEST(ProxyShapes, StepsDoNotAllocate) {
  RenderConfig config;
  config.friction = 0.3;
  config.tip_radius_m = 0.5e-3;
  const RenderModel model = make_render_model(scene_of(bumpy_sphere(0.05, 30, 0.02)), config);
  ServoState state;
  const std::size_t before = testkit::count_allocations();
  double sum_N = 0.0;
  for (int k = 0; k < 20000; ++k) {
    const Vector3d p =
        Vector3d(std::cos(2e-3 * k), std::sin(2e-3 * k), std::sin(1.7e-3 * k)).normalized() * (k < 100 ? 0.06 : 0.0495);
    sum_N += render_step(model, state, at(p)).force_N.norm();
  }
  EXPECT_EQ(testkit::count_allocations(), before);
  EXPECT_GT(sum_N, 0.0);
}

}  // namespace
}  // namespace asperity
