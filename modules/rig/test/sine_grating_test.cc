#include "asperity/rig/sine_grating.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include <Eigen/Geometry>

#include "asperity/base/error.h"
#include "asperity/rig/measure_grating.h"

namespace asperity {
namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;

TEST(SineGrating, IsClosedAndHasTheVolumeOfItsBox) {
  const TriangleMesh mesh = make_sine_grating({});
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  double volume_m3 = 0.0;
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) ++edges[{t[i], t[(i + 1) % 3]}];
    volume_m3 += mesh.vertices_m[t[0]].dot(mesh.vertices_m[t[1]].cross(mesh.vertices_m[t[2]])) / 6.0;
  }
  for (const auto& [edge, count] : edges) {
    ASSERT_EQ(count, 1);
    ASSERT_TRUE(edges.contains({edge.second, edge.first}));
  }
  // 116 mm × 30 mm × 5 mm; 10^4 signed pieces, each below that volume, round to 1e-12 of it at worst.
  EXPECT_NEAR(volume_m3, 116e-3 * 30e-3 * 5e-3, 1e-9 * 17.4e-6);
  // The relief along its middle: highest and lowest corners lie on peaks and valleys.
  const auto [low, high] = std::minmax_element(mesh.vertices_m.begin(), mesh.vertices_m.end(), [](auto& a, auto& b) {
    return (a.z() > 1e-3 ? a.z() : 5e-3) < (b.z() > 1e-3 ? b.z() : 5e-3);
  });
  EXPECT_NEAR(high->z(), 5.1e-3, 1e-9);
  EXPECT_NEAR(low->z(), 4.9e-3, 1e-9);
}

TEST(SineGrating, RefusesWhatIsNone) {
  EXPECT_THROW(make_sine_grating({.pitch_m = 0.0}), Error);
  EXPECT_THROW(make_sine_grating({.depth_m = 20e-3}), Error);
  SineGratingShape shape;
  shape.periods = 100'000'000;
  EXPECT_THROW(make_sine_grating({}, shape), Error);
}

// Against the highest of all balls' lower sides, sampled finely: the dilation by its definition.
TEST(TracedSine, IsTheSineDilatedByABall) {
  const SineGratingConfig sine;
  const double r_m = 0.32e-3;
  const TracedSine traced(sine, r_m);
  for (int i = 0; i < 40; ++i) {
    const double centre_m = sine.pitch_m * i / 40.0;
    double highest_m = -1.0;
    constexpr int kSteps = 20000;
    for (int j = -kSteps; j <= kSteps; ++j) {
      const double d_m = r_m * j / kSteps;
      const double z_m = 0.5 * sine.depth_m * std::sin(kTwoPi * (centre_m + d_m) / sine.pitch_m);
      highest_m = std::max(highest_m, z_m + std::sqrt(r_m * r_m - d_m * d_m) - r_m);
    }
    // Samples 16 nm apart miss the touching point by 8 nm: (8 nm)² (1/r − 1/R)/2 < 1e-12 m.
    EXPECT_NEAR(traced.height_m(kTwoPi * i / 40.0), highest_m, 1e-12);
  }
  EXPECT_THROW(TracedSine(sine, 1.1e-3), Error);
  EXPECT_DOUBLE_EQ(TracedSine(sine, 0.0).fundamental_share(), 1.0);
}

TEST(TracedSine, TheSecondHarmonicIsAsTheBoundSays) {
  const SineGratingConfig sine;
  const double r_m = 0.1e-3;
  const TracedSine traced(sine, r_m);
  double sum_m = 0.0;
  constexpr int kSteps = 400;
  for (int i = 0; i < kSteps; ++i) {
    const double phase = kTwoPi * i / kSteps;
    sum_m += 2.0 / kSteps * traced.height_m(phase) * std::cos(2.0 * phase);
  }
  const double bound_m = r_m * std::pow(std::numbers::pi * sine.depth_m / sine.pitch_m, 2) / 4.0;
  EXPECT_NEAR(sum_m, bound_m, 0.1 * bound_m);  // terms of the next order: (πdepth/pitch)² = 10 %
}

TEST(MeasureGrating, FindsWhatWasPutIn) {
  SineGratingConfig sine;
  const double r_m = 0.32e-3;
  const TracedSine traced(sine, r_m);
  Profile profile;
  const double stretch = 1.003;  // of the arc length
  for (int i = 0; i < 2400; ++i) {
    const double s_m = 0.025e-3 * i;
    profile.s_m.push_back(s_m);
    const double height_m = i > 900 && i < 950 ? NAN : traced.height_m(kTwoPi * s_m / (stretch * sine.pitch_m) + 1.0);
    profile.height_m.push_back(height_m + 1e-3 + 1e-4 * s_m);
    profile.texture_m.push_back(height_m);
  }
  const GratingMetrics metrics = measure_grating(profile, 2.002e-3, sine, r_m);
  EXPECT_NEAR(metrics.pitch_m, stretch * sine.pitch_m, 1e-7);
  EXPECT_NEAR(metrics.depth_m, sine.depth_m, 2e-7);
  EXPECT_LT(metrics.along_rms_m, 1e-6);
  // Windows of the found pitch are 0.2 % short of two periods: that much of the second harmonic of 8 µm leaks.
  EXPECT_LT(metrics.shape_rms_m, 5e-7);
  EXPECT_GT(metrics.correlation, 0.99999);
  EXPECT_NEAR(metrics.length_error_m, metrics.length_m * (1.0 - 1.0 / stretch), 1e-5);
  EXPECT_GT(metrics.windows, 13U);

  profile.s_m.resize(300);
  profile.height_m.resize(300);
  profile.texture_m.resize(300);
  EXPECT_TRUE(std::isnan(measure_grating(profile, 2.002e-3, sine, r_m).pitch_m));
}

}  // namespace
}  // namespace asperity
