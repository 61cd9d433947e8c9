#include "asperity/signal/tip_morphology.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/base/nan.h"
#include "asperity/base/random.h"

namespace asperity {
namespace {

constexpr double kRadius_m = 0.32e-3;
constexpr double kSpacing_m = 0.025e-3;

// The definition, point by point: the highest place at which the ball still touches.
std::vector<double> rolled_over(const std::vector<double>& z_m, std::size_t columns, double row_m, double column_m,
                                double radius_m) {
  const auto rows = static_cast<std::ptrdiff_t>(z_m.size() / columns), n = static_cast<std::ptrdiff_t>(columns);
  std::vector<double> out(z_m.size(), -1e9);
  for (std::ptrdiff_t r = 0; r < rows; ++r) {
    for (std::ptrdiff_t c = 0; c < n; ++c) {
      for (std::ptrdiff_t k = 0; k < rows; ++k) {
        for (std::ptrdiff_t j = 0; j < n; ++j) {
          const double u_m = std::hypot(static_cast<double>(k - r) * row_m, static_cast<double>(j - c) * column_m);
          if (u_m > radius_m) continue;
          double& top_m = out[static_cast<std::size_t>(r * n + c)];
          top_m = std::max(
              top_m, z_m[static_cast<std::size_t>(k * n + j)] + std::sqrt(radius_m * radius_m - u_m * u_m) - radius_m);
        }
      }
    }
  }
  return out;
}

std::vector<double> rough_m(std::size_t n, double rms_m, std::uint64_t seed) {
  Random random(seed, 0);
  std::vector<double> out(n);
  for (double& h : out) h = rms_m * random.normal();
  return out;
}

TEST(TipMorphology, ErodedHeightsAreTheSurfaceWhereTheTipTouchedIt) {
  const std::vector<double> z_m = rough_m(400, 20e-6, 1);
  const std::vector<double> d_m = rolled_over(z_m, z_m.size(), 1.0, kSpacing_m, kRadius_m);
  const TipErosion e = erode_profile_by_tip(d_m, kSpacing_m, kRadius_m);
  std::size_t touched = 0;
  for (std::size_t i = 0; i < z_m.size(); ++i) {
    EXPECT_GE(e.surface_m[i], z_m[i] - 1e-15);
    EXPECT_LE(e.surface_m[i], d_m[i] + 1e-15);
    if (e.touched[i] == 0) continue;
    ++touched;
    EXPECT_NEAR(e.surface_m[i], z_m[i], 1e-15) << i;
  }
  EXPECT_GT(touched, 30U);   // the peaks of a surface rougher than the ball
  EXPECT_LT(touched, 200U);  // and not its valleys
  const std::vector<double> again_m = rolled_over(e.surface_m, z_m.size(), 1.0, kSpacing_m, kRadius_m);
  for (std::size_t i = 20; i + 20 < z_m.size(); ++i) EXPECT_NEAR(again_m[i], d_m[i], 1e-15);
}

TEST(TipMorphology, ErodesAnArea) {
  constexpr std::size_t kColumns = 30;
  constexpr double kRow_m = 0.09e-3, kColumn_m = 0.07e-3;
  const std::vector<double> z_m = rough_m(25 * kColumns, 30e-6, 2);
  const std::vector<double> d_m = rolled_over(z_m, kColumns, kRow_m, kColumn_m, kRadius_m);
  const TipErosion e = erode_by_tip(d_m, {25, kColumns, kRow_m, kColumn_m}, kRadius_m);
  std::size_t touched = 0;
  for (std::size_t i = 0; i < z_m.size(); ++i) {
    EXPECT_GE(e.surface_m[i], z_m[i] - 1e-15);
    if (e.touched[i] == 0) continue;
    ++touched;
    EXPECT_NEAR(e.surface_m[i], z_m[i], 1e-15) << i;
  }
  EXPECT_GT(touched, 20U);
}

TEST(TipMorphology, GivesASineBackBetweenTheGridsPoints) {
  // Traced by a ball the sine's point x is seen at x + R z'/√(1 + z'²), as high as R (1/√(1 + z'²) − 1) over z.
  constexpr double kPitch_m = 2e-3, kAmplitude_m = 0.05e-3;
  const double k = 2.0 * std::numbers::pi / kPitch_m;
  ASSERT_LT(kAmplitude_m * k * k * kRadius_m, 1.0);  // the ball fits its valleys
  std::vector<double> d_m(400);
  for (std::size_t i = 0; i < d_m.size(); ++i) {
    const double at_m = kSpacing_m * static_cast<double>(i);
    double low_m = at_m - kRadius_m, high_m = at_m + kRadius_m;
    for (int step = 0; step < 60; ++step) {
      const double x_m = 0.5 * (low_m + high_m), slope = kAmplitude_m * k * std::cos(k * x_m);
      (x_m - kRadius_m * slope / std::hypot(1.0, slope) < at_m ? low_m : high_m) = x_m;
    }
    const double slope = kAmplitude_m * k * std::cos(k * low_m);
    d_m[i] = kAmplitude_m * std::sin(k * low_m) + kRadius_m * (1.0 / std::hypot(1.0, slope) - 1.0);
  }
  const TipErosion e = erode_profile_by_tip(d_m, kSpacing_m, kRadius_m, kSpacing_m);
  for (std::size_t i = 20; i + 20 < d_m.size(); ++i) {
    const double z_m = kAmplitude_m * std::sin(k * kSpacing_m * static_cast<double>(i));
    EXPECT_GE(e.surface_m[i], z_m - 1e-12);
    // a²/8 (1/R + d'') on a slope.
    EXPECT_NEAR(e.surface_m[i], z_m, 0.5e-6) << i;
    EXPECT_EQ(e.touched[i], 1) << i;
  }
}

TEST(TipMorphology, DoesNotTrustTheFloorOfAGrooveThatTheBallBridges) {
  std::vector<double> z_m(200, 0.0);
  for (std::size_t i = 96; i < 104; ++i) z_m[i] = -1e-3;  // 0.2 mm wide
  const TipErosion e = erode_profile_by_tip(rolled_over(z_m, 200, 1.0, kSpacing_m, kRadius_m), kSpacing_m, kRadius_m);
  for (std::size_t i = 30; i < 170; ++i) EXPECT_EQ(e.touched[i], i < 96 || i >= 104 ? 1 : 0) << i;
  // The ball sinks by R − √(R² − ab) between the edges, which are a = 0.1 and b = 0.125 mm away, and a little less
  // where it has to stand at the grid's points.
  EXPECT_NEAR(e.surface_m[100], -(kRadius_m - std::sqrt(kRadius_m * kRadius_m - 0.1e-3 * 0.125e-3)), 5e-6);
}

TEST(TipMorphology, KeepsGapsAndDoesNotTrustTheirNeighbours) {
  std::vector<double> d_m = rolled_over(rough_m(300, 20e-6, 3), 300, 1.0, kSpacing_m, kRadius_m);
  const TipErosion whole = erode_profile_by_tip(d_m, kSpacing_m, kRadius_m);
  for (std::size_t i = 150; i < 155; ++i) d_m[i] = kNan;
  const TipErosion e = erode_profile_by_tip(d_m, kSpacing_m, kRadius_m);
  for (std::size_t i = 0; i < 300; ++i) {
    if (i >= 150 && i < 155) {
      EXPECT_TRUE(std::isnan(e.surface_m[i]));
      EXPECT_EQ(e.touched[i], 0);
      continue;
    }
    EXPECT_GE(e.surface_m[i], whole.surface_m[i]) << i;
    EXPECT_LE(e.touched[i], whole.touched[i]) << i;
  }
}

TEST(TipMorphology, OpeningLeavesWhatTheBallHasMeasured) {
  const std::vector<double> d_m = rolled_over(rough_m(500, 20e-6, 4), 500, 1.0, kSpacing_m, kRadius_m);
  const HeightGridShape shape{1, 500, kSpacing_m, kSpacing_m};
  const std::vector<double> same_m = open_by_tip(d_m, shape, kRadius_m);
  const std::vector<double> lower_m = open_by_tip(d_m, shape, 1.5 * kRadius_m);
  double most_m = 0.0;
  for (std::size_t i = 0; i < d_m.size(); ++i) {
    EXPECT_NEAR(same_m[i], d_m[i], 1e-15);
    EXPECT_LE(lower_m[i], d_m[i]);
    most_m = std::max(most_m, d_m[i] - lower_m[i]);
  }
  EXPECT_GT(most_m, 1e-6);
}

TEST(TipMorphology, NamesWhatIsWrong) {
  const std::vector<double> d_m(12, 0.0);
  EXPECT_THROW(erode_by_tip(d_m, {5, 3, 1.0, 1.0}, 1.0), Error);
  EXPECT_THROW(erode_profile_by_tip(d_m, 0.0, 1.0), Error);
  EXPECT_THROW(erode_profile_by_tip(d_m, std::numeric_limits<double>::infinity(), 1.0), Error);
  EXPECT_THROW(erode_profile_by_tip(d_m, 1.0, -1.0), Error);
  EXPECT_THROW(erode_profile_by_tip(d_m, 1.0, kNan), Error);
  EXPECT_TRUE(erode_profile_by_tip({}, 1.0, 1.0).surface_m.empty());
  EXPECT_EQ(erode_profile_by_tip(d_m, 1.0, 0.0).surface_m, d_m);
}

}  // namespace
}  // namespace asperity
