#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include <gtest/gtest.h>
#include <Eigen/Core>

#include "scenes.h"

namespace asperity {
namespace {

using Eigen::Vector3d;
using testing_render::at;
using testing_render::bumpy_sphere;
using testing_render::scene_of;
using testing_render::stroke;

constexpr double kSphere_m = 0.05;
constexpr std::int64_t kMostWork = 3 << 17;  // two moves of the proxy and their last evaluations; a millisecond or so

// A globe whose pole has one triangle for each of `segments` meridians.
TriangleMesh globe(int segments, int rings) {
  TriangleMesh mesh;
  mesh.vertices_m.emplace_back(0.0, 0.0, kSphere_m);
  for (int r = 1; r < rings; ++r) {
    const double polar = std::numbers::pi * r / rings;
    for (int s = 0; s < segments; ++s) {
      const double turn = 2.0 * std::numbers::pi * s / segments;
      mesh.vertices_m.push_back(
          kSphere_m * Vector3d(std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn), std::cos(polar)));
    }
  }
  const auto place = [&](int r, int s) { return static_cast<std::uint32_t>(1 + (r - 1) * segments + s % segments); };
  for (int s = 0; s < segments; ++s) {
    mesh.triangles.push_back({0, place(1, s), place(1, s + 1)});
    for (int r = 1; r + 1 < rings; ++r) {
      mesh.triangles.push_back({place(r, s), place(r + 1, s), place(r + 1, s + 1)});
      mesh.triangles.push_back({place(r, s), place(r + 1, s + 1), place(r, s + 1)});
    }
  }
  return mesh;
}

TEST(BoundedWork, GlitchesOfTheDeviceAreShortAndHarmless) {
  const RenderModel model = make_render_model(scene_of(bumpy_sphere(kSphere_m, 20, 0.0)), {});
  for (const double glitch_m : {0.1, 0.3, 10.0, 1e10, 1e100, 1e150, 1e160, 1e308}) {
    const auto state = std::make_unique<ServoState>();
    stroke(model, *state, {0.0, 0.0, 0.06}, {0.0, 0.0, 0.049}, 1e-4);
    const ServoOutput far = render_step(model, *state, at({glitch_m, 0.0, 0.0}));
    EXPECT_LE(state->proxy.work, kMostWork) << glitch_m;
    if (glitch_m >= 1e160) {
      EXPECT_EQ(far.force_N, Vector3d::Zero()) << glitch_m;
    }
    for (int k = 0; k < 200; ++k) {
      render_step(model, *state, at({glitch_m, 0.0, 0.0}));
      EXPECT_LE(state->proxy.work, kMostWork) << glitch_m;
    }
    // Back at the sphere's far side, which the proxy reaches around the sphere within some ticks.
    ServoOutput out;
    for (int k = 0; k < 2000; ++k) out = render_step(model, *state, at({0.0, 0.0, 0.049}));
    EXPECT_NEAR(out.force_N.norm(), 1.0, 0.2) << glitch_m;
  }
}

TEST(BoundedWork, JumpsThroughTheSphereStayOutside) {
  const RenderModel model = make_render_model(scene_of(bumpy_sphere(kSphere_m, 20, 0.02)), {});
  const auto state = std::make_unique<ServoState>();
  render_step(model, *state, at({0.0, 0.0, 0.1}));
  for (int k = 0; k < 100; ++k) {
    const double turn = 2.4 * k;
    render_step(model, *state, at(0.1 * Vector3d(std::cos(turn), std::sin(turn), std::cos(0.7 * turn))));
    ASSERT_LE(state->proxy.work, kMostWork) << k;
    ASSERT_GE(state->proxy.p_world_m.norm(), 0.9 * kSphere_m) << k;
  }
}

// More triangles meet at the pole than a list holds.
TEST(BoundedWork, PoleOfThreeThousandTriangles) {
  for (const double tip_m : {0.0, 0.5e-3}) {
    RenderConfig config;
    config.tip_radius_m = tip_m;
    const RenderModel model = make_render_model(scene_of(globe(3000, 64)), config);
    const auto state = std::make_unique<ServoState>();
    const double pressed_m = kSphere_m + tip_m - 1e-3;
    const auto place_m = [&](double x_m) { return Vector3d(pressed_m * Vector3d(x_m, 1e-5, kSphere_m).normalized()); };
    stroke(model, *state, 1.2 * place_m(-0.4e-3), place_m(-0.4e-3), 1e-4);
    int frozen = 0;
    double worst_N = 0.0;
    std::int64_t most_work = 0;
    for (int k = 0; k < 160; ++k) {
      const Vector3d before_m = state->proxy.p_world_m;
      const ServoOutput out = render_step(model, *state, at(place_m(-0.4e-3 + 5e-6 * k)));
      if (k < 20) continue;
      frozen += state->proxy.p_world_m == before_m;
      worst_N = std::max(worst_N, std::abs(out.force_N.norm() - 1.0));
      most_work = std::max(most_work, state->proxy.work);
    }
    EXPECT_EQ(frozen, 0) << tip_m;
    // The facets of 64 rings lie up to R (1 - cos(pi / 128)) = 15 um below the sphere; 1000 N/m.
    EXPECT_LE(worst_N, 16e-3) << tip_m;
    EXPECT_LE(most_work, kMostWork) << tip_m;
  }
}

}  // namespace
}  // namespace asperity
