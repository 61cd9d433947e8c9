#include "tip_dilation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace asperity {
namespace {

constexpr double kSpacing_m = 5e-6;
constexpr double kTip_m = 0.32e-3;
constexpr double kPi = std::numbers::pi;

template <class F>
std::vector<double> profile(F height_m, double length_m) {
  std::vector<double> out;
  for (std::size_t i = 0; static_cast<double>(i) * kSpacing_m <= length_m; ++i) {
    out.push_back(height_m(static_cast<double>(i) * kSpacing_m));
  }
  return out;
}

// The greatest of a function on a fine grid exceeds that on the tip's grid by at most curvature · (step/2)²/2,
// the curvature that of the tip and the relief together, up to 6/mm here.
constexpr double kGridTol_m = 2.5e-8;

TEST(DilateByTip, SmoothSineFollowsItsParallelCurve) {
  // Curvature A (2π/λ)² = 1/mm < 1/r: the tip touches everywhere, so its centre runs on the parallel curve.
  const double amplitude_m = 0.1e-3;
  const double turn_per_m = 2.0 * kPi / 2e-3;
  const auto out = dilate_by_tip(profile([&](double x) { return amplitude_m * std::sin(turn_per_m * x); }, 10e-3),
                                 kSpacing_m, kTip_m);
  for (double x = 3e-3; x < 7e-3; x += 13e-6) {
    const double slope = amplitude_m * turn_per_m * std::cos(turn_per_m * x);
    const double norm = std::hypot(1.0, slope);
    const double centre_m = x - kTip_m * slope / norm;
    const double bottom_m = amplitude_m * std::sin(turn_per_m * x) + kTip_m / norm - kTip_m;
    const double place = centre_m / kSpacing_m;
    const auto i = static_cast<std::size_t>(place);
    const double u = place - static_cast<double>(i);
    EXPECT_NEAR(out[i] + u * (out[i + 1] - out[i]), bottom_m, kGridTol_m);
  }
}

TEST(DilateByTip, SharpSineLosesItsValleys) {
  // Curvature 6/mm > 1/r: peaks stay, valleys end in cusps where two flanks are touched at once.
  const double amplitude_m = 0.1e-3;
  const double turn_per_m = 2.0 * kPi / 0.8e-3;
  const auto out = dilate_by_tip(profile([&](double x) { return amplitude_m * std::sin(turn_per_m * x); }, 4e-3),
                                 kSpacing_m, kTip_m);
  const auto at = [&](double x) { return out[static_cast<std::size_t>(std::lround(x / kSpacing_m))]; };
  EXPECT_NEAR(at(1.0e-3), amplitude_m, kGridTol_m);
  double deepest_m = -1.0;  // brute force: the first flank point that the sphere over the valley touches
  for (double u = 0.0; u < kTip_m; u += 1e-9) {
    deepest_m =
        std::max(deepest_m, -amplitude_m * std::cos(turn_per_m * u) + std::sqrt(kTip_m * kTip_m - u * u) - kTip_m);
  }
  EXPECT_GT(deepest_m, -0.99 * amplitude_m);
  EXPECT_NEAR(at(1.4e-3), deepest_m, kGridTol_m);
}

TEST(DilateByTip, RollsOverAStepAndHangsInAGroove) {
  const auto step = dilate_by_tip(profile([](double x) { return x < 1e-3 ? 0.0 : -1e-3; }, 3e-3), kSpacing_m, kTip_m);
  const auto groove = dilate_by_tip(
      profile([](double x) { return std::abs(x - 1e-3) < 0.2001e-3 ? -1e-3 : 0.0; }, 2e-3), kSpacing_m, kTip_m);
  const double edge_m = 1e-3 - kSpacing_m;  // the last sample of the upper level
  for (int i = 0; i < 60; ++i) {
    const double u = i * kSpacing_m;
    EXPECT_NEAR(step[static_cast<std::size_t>(std::lround((edge_m + u) / kSpacing_m))],
                std::sqrt(kTip_m * kTip_m - u * u) - kTip_m, 1e-12);
  }
  EXPECT_DOUBLE_EQ(step.back(), -1e-3);
  const double half_m = 0.205e-3;  // to the first sample of the groove's rim
  EXPECT_NEAR(groove[200], std::sqrt(kTip_m * kTip_m - half_m * half_m) - kTip_m, 1e-12);
}

TEST(SmoothByContact, KeepsPlanesAndWeakensSines) {
  const double radius_m = 0.3e-3;
  const auto plane = smooth_by_contact(profile([](double x) { return 0.2 * x; }, 4e-3), kSpacing_m, radius_m);
  EXPECT_NEAR(plane[400], 0.2 * 2e-3, 1e-15);
  // The transform of a semi-ellipse is 2 J1(ka)/(ka).
  const double k = 2.0 * kPi / 1e-3;
  const auto sine = smooth_by_contact(profile([&](double x) { return std::sin(k * x); }, 4e-3), kSpacing_m, radius_m);
  EXPECT_NEAR(sine[450], 2.0 * std::cyl_bessel_j(1.0, k * radius_m) / (k * radius_m), 2e-3);
}

}  // namespace
}  // namespace asperity
