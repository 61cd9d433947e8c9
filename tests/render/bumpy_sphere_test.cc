// A few seconds of stroking the bumpy sphere, judged against the exactly tracked minimum; bench/render_soak.cc does 100
// s.
#include <gmock/gmock.h>

#include <cmath>
#include <memory>
#include <ostream>

#include "asperity/testkit/bumpy_sphere.h"
#include "asperity/testkit/proxy_judge.h"
#include "asperity/testkit/wandering_path.h"
#include "render_rig.h"

namespace asperity::render_test {
namespace {

using Eigen::Vector3d;

constexpr double kDepth_m = 1e-3, kRadius_m = 50e-3;

struct Stroke {
  double tip_m;
  double speed_mps;
  std::size_t ticks;
  double friction;
};

void PrintTo(const Stroke& stroke, std::ostream* out) {
  *out << 1e3 * stroke.tip_m << " mm tip, " << 1e3 * stroke.speed_mps << " mm/s, friction " << stroke.friction;
}

class BumpySphere : public testing::TestWithParam<Stroke> {
 protected:
  static void SetUpTestSuite() { mesh_ = std::make_unique<TriangleMesh>(testkit::bumpy_sphere_mesh(59)); }
  static void TearDownTestSuite() { mesh_.reset(); }
  static std::unique_ptr<TriangleMesh> mesh_;
};
std::unique_ptr<TriangleMesh> BumpySphere::mesh_;

INSTANTIATE_TEST_SUITE_P(Strokes, BumpySphere,
                         testing::Values(Stroke{0.0, 0.02, 10000, 0.0}, Stroke{0.0, 0.1, 10000, 0.0},
                                         Stroke{0.5e-3, 0.02, 5000, 0.0}, Stroke{0.5e-3, 0.1, 5000, 0.0},
                                         Stroke{2e-3, 0.1, 3000, 0.0}, Stroke{0.0, 0.1, 10000, 0.3},
                                         Stroke{0.5e-3, 0.02, 5000, 0.3}, Stroke{2e-3, 0.1, 3000, 0.3}));

TEST_P(BumpySphere, NeitherSticksNorPopsThroughNorJumps) {
  const Stroke& stroke = GetParam();
  const MeshBvh bvh(*mesh_);
  const testkit::PressedPath path = testkit::press_into(
      bvh, testkit::wandering_directions(stroke.ticks, stroke.speed_mps * 1e-3 / kRadius_m, 1), stroke.tip_m, kDepth_m);
  RenderConfig config;
  config.tip_radius_m = stroke.tip_m;
  config.friction = stroke.friction;
  Rig rig(scene_of({*mesh_}), config);
  testkit::ProxyJudge judge(*mesh_, bvh, {stroke.tip_m, kDepth_m, stroke.friction == 0.0});
  double largest_N = 0.0;
  for (const Vector3d& p : path.p_m) {
    const ServoOutput out = rig.step(p);
    judge.tick(p, out.proxy_m);
    ASSERT_LE(out.friction_N.norm(), 1.2 * stroke.friction * out.contact_N.norm() * (1.0 + 1e-6) + 1e-9);
    largest_N = std::max(largest_N, out.force_N.norm());
  }
  const testkit::ProxyStatistics f = judge.statistics();
  EXPECT_EQ(f.stuck_events, 0u) << "lag of up to " << 1e3 * f.largest_lag_m << " mm";
  EXPECT_EQ(f.pop_throughs, 0u) << "inside by up to " << 1e6 * f.deepest_proxy_m << " µm";
  EXPECT_LE(f.deepest_proxy_m, 1e-9);
  EXPECT_LE(largest_N, 1.5 * kStiffness_N_per_m * kDepth_m);
  if (stroke.friction > 0.0) return;
  EXPECT_EQ(f.frozen_ticks, 0u);
  EXPECT_LE(kStiffness_N_per_m * f.rms_error_m, 10e-3);
  EXPECT_LE(kStiffness_N_per_m * f.rms_local_m, 5e-3);
}

}  // namespace
}  // namespace asperity::render_test
