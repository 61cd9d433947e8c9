// Shapes that are hard on a proxy: jagged, with slivers, with triangles of no area, of very unequal size.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <ostream>

#include "asperity/base/random.h"
#include "asperity/geometry/pose.h"
#include "asperity/testkit/bumpy_sphere.h"
#include "asperity/testkit/proxy_judge.h"
#include "asperity/testkit/tracked_minimum.h"
#include "asperity/testkit/wandering_path.h"
#include "render_rig.h"

namespace asperity::render_test {
namespace {

using Eigen::Vector3d;

constexpr double kRadius_m = 50e-3;

struct Jagged {
  double tip_m;
  double roughness;  // of the radius, random at each vertex
  double depth_m;
};

void PrintTo(const Jagged& j, std::ostream* out) {
  *out << 1e3 * j.tip_m << " mm tip, " << 1e3 * j.depth_m << " mm deep, vertices moved by up to " << j.roughness;
}

class JaggedSphere : public testing::TestWithParam<Jagged> {};
INSTANTIATE_TEST_SUITE_P(Cases, JaggedSphere,
                         testing::Values(Jagged{0.0, 0.05, 1e-3}, Jagged{0.0, 0.15, 3e-3}, Jagged{0.5e-3, 0.05, 1e-3},
                                         Jagged{0.5e-3, 0.15, 3e-3}, Jagged{2e-3, 0.15, 1e-3},
                                         Jagged{2e-3, 0.15, 3e-3}));

// The steepest way down at `proxy_m`: among directions at random, by how much a place a micrometre aside that is free
// is nearer to the device, a micrometre.
double steepest_free_descent(const MeshBvh& bvh, double tip_m, const Vector3d& proxy_m, const Vector3d& device_m,
                             Random& random) {
  constexpr double kAside_m = 1e-6;
  const double lag_m = (proxy_m - device_m).norm();
  double steepest = 0.0;
  for (int k = 0; k < 100 && lag_m > 10.0 * kAside_m; ++k) {
    const Vector3d aside = Vector3d(random.normal(), random.normal(), random.normal()).normalized();
    const Vector3d x = proxy_m + kAside_m * aside;
    const double slope = (lag_m - (x - device_m).norm()) / kAside_m;
    if (slope <= steepest) continue;
    const double surface_m = testkit::touching_radius_m(bvh, x.normalized(), 0.0, 2.0 * x.norm());
    if (x.norm() >= surface_m && bvh.closest_point(x).distance_m >= tip_m) steepest = slope;
  }
  return steepest;
}

// Crests and grooves of every angle, saddles at most vertices. Where faces fold, the device can be in front of some of
// them: the minimum over the surface is not that over the free space, so the place itself is probed.
TEST_P(JaggedSphere, ProxyIsAtALocalMinimumOutside) {
  testkit::BumpySphere round;
  round.waves = 0;
  TriangleMesh mesh = testkit::bumpy_sphere_mesh(16, round);  // edges of about 4 mm
  Random random(41);
  for (Vector3d& p : mesh.vertices_m) p *= 1.0 + GetParam().roughness * random.uniform(-1.0, 1.0);
  const MeshBvh bvh(mesh);
  const testkit::PressedPath path = testkit::press_into(bvh, testkit::wandering_directions(6000, 1e-4 / kRadius_m, 42),
                                                        GetParam().tip_m, GetParam().depth_m);
  RenderConfig config;
  config.tip_radius_m = GetParam().tip_m;
  Rig rig(scene_of({mesh}), config);
  testkit::ProxyJudge judge(mesh, bvh, {GetParam().tip_m, GetParam().depth_m, false});
  int probed = 0, not_minimal = 0, first = -1;
  for (std::size_t i = 0; i < path.p_m.size(); ++i) {
    const ServoOutput out = rig.step(path.p_m[i]);
    judge.tick(path.p_m[i], out.proxy_m);
    if (i < path.first_pressed || i % 3 != 0) continue;
    ++probed;
    const bool falls = steepest_free_descent(bvh, GetParam().tip_m, out.proxy_m, path.p_m[i], random) > 0.05;
    if (falls && first < 0) first = static_cast<int>(i);
    not_minimal += falls;
  }
  EXPECT_EQ(judge.statistics().pop_throughs, 0u) << 1e6 * judge.statistics().deepest_proxy_m << " µm inside";
  // Where a minimum has just vanished the way down may take a second tick.
  EXPECT_LE(not_minimal, probed / 200) << "first at tick " << first;
}

TEST(HardShapes, TrianglesWithoutAreaAreNotFelt) {
  for (const double tip_m : {0.0, 2e-3}) {
    TriangleMesh mesh = sheet(40e-3, 10);
    const auto vertices = static_cast<std::uint32_t>(mesh.vertices_m.size());
    Random random(43);
    const auto any = [&] { return static_cast<std::uint32_t>(random.uniform(0.0, vertices)); };
    for (int k = 0; k < 50; ++k) {
      const std::uint32_t a = any(), b = any();
      mesh.triangles.push_back({a, a, b});
      mesh.triangles.push_back({a, a, a});
      // Three points of a line within the plane.
      mesh.vertices_m.push_back(0.5 * (mesh.vertices_m[a] + mesh.vertices_m[b]));
      mesh.triangles.push_back({a, static_cast<std::uint32_t>(mesh.vertices_m.size() - 1), b});
    }
    RenderConfig config;
    config.tip_radius_m = tip_m;
    Rig rig(scene_of({mesh}), config);
    rig.step({-10e-3, -9e-3, 5e-3});
    for (int k = 0; k < 1000; ++k) {
      const double depth_m = std::min(2e-3, 10e-6 * k);
      const ServoOutput out = rig.step({-10e-3 + 20e-6 * k, -9e-3 + 18e-6 * k, tip_m - depth_m});
      ASSERT_LE((out.force_N - kStiffness_N_per_m * depth_m * Vector3d::UnitZ()).norm(), settled_N(tip_m)) << k;
    }
  }
}

TEST(HardShapes, SliversAndGiantsInAPlaneAreAPlane) {
  // Fans of needles a micrometre thin beside triangles of 20 mm.
  TriangleMesh mesh{{{-20e-3, -20e-3, 0}, {20e-3, -20e-3, 0}, {20e-3, 20e-3, 0}, {-20e-3, 20e-3, 0}}, {}};
  constexpr std::uint32_t kNeedles = 200;
  for (std::uint32_t k = 0; k <= kNeedles; ++k) mesh.vertices_m.push_back({1e-6 * k, 1e-3, 0});
  mesh.triangles = {{0, 1, 4}, {1, 4 + kNeedles, 4}, {1, 2, 4 + kNeedles}, {0, 4, 3}, {2, 3, 4 + kNeedles}};
  for (std::uint32_t k = 0; k < kNeedles; ++k) mesh.triangles.push_back({4 + k, 5 + k, 3});
  for (const double tip_m : {0.0, 0.5e-3, 2e-3}) {
    RenderConfig config;
    config.tip_radius_m = tip_m;
    Rig rig(scene_of({mesh}), config);
    rig.step({-5e-3, -3e-3, 5e-3});
    rig.go({-5e-3, -3e-3, tip_m - 1e-3});
    for (int k = 0; k < 2000; ++k) {
      const ServoOutput out = rig.step({-5e-3 + 5e-6 * k, -3e-3 + 4e-6 * k, tip_m - 1e-3});
      ASSERT_LE((out.force_N - Vector3d::UnitZ()).norm(), settled_N(tip_m)) << tip_m << " " << k;
    }
  }
}

class Tip : public OfTipRadii {};
INSTANTIATE_TEST_SUITE_P(Radii, Tip, kRadii_m);

// A hand cannot do that, a replayed path or a device that lost its place can.
TEST_P(Tip, JumpsOfCentimetresDoNotLeadInside) {
  const TriangleMesh mesh = testkit::bumpy_sphere_mesh(30);
  const MeshBvh bvh(mesh);
  for (const double friction : {0.0, 0.5}) {
    RenderConfig rubbing = config();
    rubbing.friction = friction;
    Rig rig(scene_of({mesh}), rubbing);
    testkit::ProxyJudge judge(mesh, bvh, {GetParam(), 1e-3, false});
    Random random(44);
    rig.step({0.0, 0.0, 70e-3});
    Vector3d p(0.0, 0.0, 60e-3);
    int first = -1;
    for (int k = 0; k < 1500; ++k) {
      p += 15e-3 * Vector3d(random.normal(), random.normal(), random.normal());
      p *= random.uniform(30e-3, 65e-3) / p.norm();
      const ServoOutput out = rig.step(p);
      judge.tick(p, out.proxy_m);
      if (first < 0 && judge.statistics().pop_throughs > 0) first = k;
      ASSERT_TRUE(out.force_N.allFinite() && out.proxy_m.allFinite());
    }
    EXPECT_EQ(judge.statistics().pop_throughs, 0u)
        << 1e6 * judge.statistics().deepest_proxy_m << " µm inside, first at " << first << ", friction " << friction;
  }
}

TEST_P(Tip, MayBePushedThroughTheMiddleAndOutBehind) {
  testkit::BumpySphere round;
  round.waves = 0;
  const TriangleMesh mesh = testkit::bumpy_sphere_mesh(30, round);
  const MeshBvh bvh(mesh);
  Rig rig(scene_of({mesh}), config());
  testkit::ProxyJudge judge(mesh, bvh, {GetParam(), 1e-3, false});
  ServoOutput out;
  for (int k = 0; k <= 1200; ++k) {
    const Vector3d p(20e-3, 10e-3, 60e-3 - 0.1e-3 * k);
    out = rig.step(p);
    judge.tick(p, out.proxy_m);
  }
  EXPECT_EQ(judge.statistics().pop_throughs, 0u);
  // A sphere has no place that holds the proxy in front while the device is behind.
  for (int k = 0; k < 200; ++k) out = rig.step({20e-3, 10e-3, -60e-3});
  EXPECT_LE(out.force_N.norm(), 1e-6);
}

TEST_P(Tip, FarFromTheOriginAndTurnedItFeelsTheSame) {
  const TriangleMesh mesh = testkit::bumpy_sphere_mesh(30);
  const testkit::PressedPath path =
      testkit::press_into(MeshBvh(mesh), testkit::wandering_directions(2000, 4e-4, 45), GetParam(), 1e-3);
  const Pose T_world_mesh{Eigen::Quaterniond(0.5, 0.5, -0.5, 0.5), {12.0, -7.0, 3.0}};  // a third of a turn
  Scene scene = scene_of({mesh});
  Rig here(scene, config());
  scene.objects[0].T_world_mesh = T_world_mesh;
  Rig there(scene, config());
  int apart = 0;
  for (const Vector3d& p : path.p_m) {
    const Vector3d force_N = T_world_mesh.rotation * here.step(p).force_N;
    // Rounding, 1e-15 m at 12 m, may choose another way down where a minimum vanishes.
    apart += (there.step(T_world_mesh * p).force_N - force_N).norm() > 1e-4;
  }
  EXPECT_LE(apart, 20);
}

TEST_P(Tip, FollowsTheLinesOfARegularGridExactly) {
  Rig rig(scene_of({sheet(40e-3, 40, 0.0)}), config());
  rig.step({-10e-3, 0.0, 5e-3});
  rig.go({-10e-3, 0.0, GetParam() - 1e-3});
  // Along a line of edges from corner to corner, then along the cells' diagonals.
  for (int k = 0; k <= 400; ++k) {
    const ServoOutput out = rig.step({-10e-3 + 0.05e-3 * k, 0.0, GetParam() - 1e-3});
    ASSERT_LE((out.force_N - Vector3d::UnitZ()).norm(), settled_N(GetParam())) << k;
  }
  for (int k = 0; k <= 200; ++k) {
    const ServoOutput out = rig.step({10e-3 - 0.05e-3 * k, 0.05e-3 * k, GetParam() - 1e-3});
    ASSERT_LE((out.force_N - Vector3d::UnitZ()).norm(), settled_N(GetParam())) << k;
  }
}

TEST(HardShapes, ApexDoesNotHoldAPoint) {
  const TriangleMesh pyramid{
      {{0, 0, 0}, {20e-3, 0, -20e-3}, {0, 20e-3, -20e-3}, {-20e-3, 0, -20e-3}, {0, -20e-3, -20e-3}},
      {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}}};
  for (const double aside_m : {0.0, 1e-9, 1e-5}) {
    Rig rig(scene_of({pyramid}));
    rig.step({aside_m, 0.4 * aside_m, 3e-3});
    const ServoOutput out = rig.go({aside_m, 0.4 * aside_m, -1e-3});
    // The faces, with normals (±1, ±1, 1)/√3, are 1/√3 mm away.
    EXPECT_NEAR(out.force_N.norm(), 1.0 / std::sqrt(3.0), 2e-2) << aside_m;
  }
}

// Convex and concave edges meet in one corner: the free space about it is not convex.
TEST(HardShapes, SaddleLetsThePointGo) {
  // Four triangles about the origin: heights of the rim go up and down twice.
  const double h = 8e-3;
  const TriangleMesh saddle{{{0, 0, 0}, {10e-3, 0, h}, {0, 10e-3, -h}, {-10e-3, 0, h}, {0, -10e-3, -h}},
                            {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}}};
  Rig rig(scene_of({saddle}));
  testkit::TrackedMinimum minimum(saddle);
  rig.step({0.2e-3, -4e-3, 5e-3});
  rig.go({0.2e-3, -4e-3, -4e-3});
  minimum.start(3, {0.2e-3, -4e-3, -4e-3});
  for (int k = 0; k <= 400; ++k) {
    // Along the ridge over the saddle, 1 mm below it.
    const double y_m = -4e-3 + 20e-6 * k;
    const Vector3d p(0.2e-3, y_m, -0.8 * std::abs(y_m) - 1e-3);
    const ServoOutput out = rig.step(p);
    const Vector3d force_N = kStiffness_N_per_m * (minimum.follow(p).p_m - p);
    ASSERT_LE((out.force_N - force_N).norm(), 1e-3) << k;
  }
}

}  // namespace
}  // namespace asperity::render_test
