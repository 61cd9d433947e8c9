// Shapes that are hard on a proxy: jagged, with slivers, with triangles of no area, of very unequal size.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <ostream>

#include "asperity/base/random.h"
#include "asperity/testkit/bumpy_sphere.h"
#include "asperity/testkit/proxy_judge.h"
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

// Crests and grooves of every angle, saddles at most vertices.
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
  testkit::ProxyJudge judge(mesh, bvh, {GetParam().tip_m, GetParam().depth_m, true});
  for (const Vector3d& p : path.p_m) judge.tick(p, rig.step(p).proxy_m);
  const testkit::ProxyFigures f = judge.figures();
  EXPECT_EQ(f.pop_throughs, 0u) << 1e6 * f.deepest_proxy_m << " µm inside";
  EXPECT_EQ(f.frozen_ticks, 0u);
  EXPECT_LE(kStiffness_N_per_m * f.rms_local_m, 10e-3);
  EXPECT_LE(f.largest_lag_m, f.largest_true_lag_m * 1.2);
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
      ASSERT_LE((out.force_N - kStiffness_N_per_m * depth_m * Vector3d::UnitZ()).norm(), 1e-6) << k;
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
      ASSERT_LE((out.force_N - Vector3d::UnitZ()).norm(), 1e-6) << tip_m << " " << k;
    }
  }
}

}  // namespace
}  // namespace asperity::render_test
