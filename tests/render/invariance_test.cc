// What a servo step has to keep: the unit of length, the bits, and the heap.
#include <gmock/gmock.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <ostream>
#include <vector>

#include "asperity/testkit/bumpy_sphere.h"
#include "asperity/testkit/count_allocations.h"
#include "asperity/testkit/wandering_path.h"
#include "render_rig.h"

namespace asperity::render_test {
namespace {

using Eigen::Vector3d;

constexpr int kFrequency = 30;  // 18,000 triangles

struct Case {
  double tip_m;
  double friction;
};

void PrintTo(const Case& c, std::ostream* out) { *out << 1e3 * c.tip_m << " mm tip, friction " << c.friction; }

class Invariance : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Tips, Invariance,
                         testing::Values(Case{0.0, 0.0}, Case{0.0, 0.5}, Case{0.5e-3, 0.0}, Case{2e-3, 0.5}));

RenderConfig config_of(const Case& c, double scale) {
  RenderConfig config;
  config.tip_radius_m = scale * c.tip_m;
  config.border_fade_m *= scale;
  config.friction = c.friction;
  return config;
}

TEST_P(Invariance, PowersOfTwoScaleTheForceBitByBit) {
  const TriangleMesh mesh = testkit::bumpy_sphere_mesh(kFrequency);
  const testkit::PressedPath path =
      testkit::press_into(MeshBvh(mesh), testkit::wandering_directions(1000, 1e-4 / 50e-3, 21), GetParam().tip_m, 1e-3);
  std::vector<ServoOutput> reference;
  Rig rig(scene_of({mesh}), config_of(GetParam(), 1.0));
  for (const Vector3d& p : path.p_m) reference.push_back(rig.step(p));
  for (const double scale : {std::ldexp(1.0, 20), std::ldexp(1.0, -20), 2.0}) {
    Rig other(scene_of({scaled(mesh, scale)}), config_of(GetParam(), scale));
    for (std::size_t i = 0; i < path.p_m.size(); ++i) {
      const ServoOutput out = other.step(scale * path.p_m[i]);
      const Vector3d force_N = scale * reference[i].force_N, proxy_m = scale * reference[i].proxy_m;
      for (int k = 0; k < 3; ++k) {
        ASSERT_EQ(std::bit_cast<std::uint64_t>(out.force_N[k]), std::bit_cast<std::uint64_t>(force_N[k]))
            << "scale " << scale << " tick " << i;
        ASSERT_EQ(std::bit_cast<std::uint64_t>(out.proxy_m[k]), std::bit_cast<std::uint64_t>(proxy_m[k]));
      }
      ASSERT_EQ(out.contact.triangle, reference[i].contact.triangle);
    }
  }
}

TEST_P(Invariance, TheSameInputGivesTheSameBits) {
  const TriangleMesh mesh = testkit::bumpy_sphere_mesh(kFrequency);
  const testkit::PressedPath path =
      testkit::press_into(MeshBvh(mesh), testkit::wandering_directions(500, 1e-4 / 50e-3, 22), GetParam().tip_m, 1e-3);
  Rig one(scene_of({mesh}), config_of(GetParam(), 1.0)), two(scene_of({mesh}), config_of(GetParam(), 1.0));
  for (const Vector3d& p : path.p_m) ASSERT_EQ(one.step(p).force_N, two.step(p).force_N);
}

TEST_P(Invariance, NoAllocationInTenThousandSteps) {
  const TriangleMesh mesh = testkit::bumpy_sphere_mesh(kFrequency);
  const testkit::PressedPath path = testkit::press_into(
      MeshBvh(mesh), testkit::wandering_directions(10000, 1e-4 / 50e-3, 23), GetParam().tip_m, 1e-3);
  Rig rig(scene_of({mesh}), config_of(GetParam(), 1.0));
  const std::size_t before = testkit::count_allocations();
  for (const Vector3d& p : path.p_m) rig.step(p);
  EXPECT_EQ(testkit::count_allocations(), before);
}

}  // namespace
}  // namespace asperity::render_test
