#include "asperity/profile/measure_arc_length.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gmock/gmock.h>

#include "asperity/base/random.h"
#include "synthetic_path.h"

namespace asperity {
namespace {

using namespace synthetic;

constexpr double kRate_hz = 1000.0;

// A stroke along x of a known way: at rest until 0.6 s, ramps of 0.3 s, 20 mm/s, at rest from 4.6 s to 5.4 s.
struct Stroke {
  std::vector<double> t_s, true_m;
  std::vector<Eigen::Vector2d> u_m;
};

// The way of a speed that rises and falls over 0.3 s like (1 − cos)/2, by its closed integral.
double way_m(double t_s) {
  constexpr double kSpeed_mps = 0.02, kFrom_s = 0.6, kRamp_s = 0.3, kTo_s = 4.6;
  const auto ramp = [](double t) {
    const double u = std::clamp(t / kRamp_s, 0.0, 1.0);
    const double inside = 0.5 * kRamp_s * (u - std::sin(std::numbers::pi * u) / std::numbers::pi);
    return inside + std::max(0.0, t - kRamp_s);
  };
  return kSpeed_mps * (ramp(t_s - kFrom_s) - ramp(t_s - (kTo_s - kRamp_s)));
}

constexpr double kWay_m = 0.02 * (4.0 - 0.3);

Stroke make_stroke() {
  Stroke out;
  for (int i = 0; i <= static_cast<int>(5.4 * kRate_hz); ++i) {
    out.t_s.push_back(i / kRate_hz);
    out.true_m.push_back(way_m(out.t_s.back()));
    out.u_m.emplace_back(out.true_m.back(), 0.0);
  }
  return out;
}

TEST(ArcLength, OfAStrokeBetweenRestsIsItsWay) {
  const Stroke stroke = make_stroke();
  const ArcLength arc = measure_arc_length(stroke.t_s, stroke.u_m, {}, {});
  EXPECT_NEAR(arc.s_m.back(), kWay_m, 1e-7);
  for (std::size_t i = 0; i < arc.s_m.size(); ++i) EXPECT_NEAR(arc.s_m[i], stroke.true_m[i], 1e-7) << stroke.t_s[i];
  EXPECT_TRUE(arc.turning_points.empty());
}

// s was held at the rest's mean and jumped from there to where the tip had got: 0.2 mm, at the profile's ends.
TEST(ArcLength, HasNoStepWhereATipThatCreepsComesToRest) {
  Stroke stroke = make_stroke();
  for (std::size_t i = 0; i < stroke.t_s.size(); ++i) {
    // 0.3 mm more, ever slower, as over rubber.
    const double since_s = std::max(0.0, stroke.t_s[i] - 4.3);
    stroke.true_m[i] += 0.3e-3 * (1.0 - std::exp(-since_s / 0.15));
    stroke.u_m[i].x() = stroke.true_m[i];
  }
  const ArcLength arc = measure_arc_length(stroke.t_s, stroke.u_m, {}, {});
  for (std::size_t i = 1; i < arc.s_m.size(); ++i)
    EXPECT_LE(arc.s_m[i] - arc.s_m[i - 1], 2.5e-5) << stroke.t_s[i];  // 20 mm/s and the creep
  EXPECT_NEAR(arc.s_m.back(), stroke.true_m.back(), 0.02e-3);
}

TEST(ArcLength, RestsAddNoLengthOfTheirNoise) {
  double sum_m = 0.0;
  constexpr int kSeeds = 20;
  constexpr double kSigma_m = 0.05e-3;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    Stroke stroke = make_stroke();
    const auto of = [&](int k) { return static_cast<std::uint64_t>(10 * seed + k); };
    SlowNoise x(kSigma_m, 1.0, kRate_hz, of(0)), y(kSigma_m, 1.0, kRate_hz, of(1));
    for (Eigen::Vector2d& u : stroke.u_m) u += Eigen::Vector2d(x.next(), y.next());
    ArcLengthConfig config;
    config.noise_m = kSigma_m;
    const double error_m = measure_arc_length(stroke.t_s, stroke.u_m, {}, config).s_m.back() - kWay_m;
    EXPECT_LT(std::abs(error_m), 4.0 * std::numbers::sqrt2 * kSigma_m) << seed;
    sum_m += error_m;
  }
  // Errors of two ends of σ each, over 20 strokes: three standard errors of the mean.
  EXPECT_LT(std::abs(sum_m) / kSeeds, 3.0 * std::numbers::sqrt2 * kSigma_m / std::sqrt(static_cast<double>(kSeeds)));
}

// Noise of the size of the seed's probe, quick enough to look like motion while the tip rests on the way.
TEST(ArcLength, NoiseInARestOnTheWayIsNoTravel) {
  constexpr double kSigma_m = 0.3e-3;
  for (int seed = 1; seed <= 8; ++seed) {
    std::vector<double> t_s;
    std::vector<Eigen::Vector2d> u_m;
    const auto of = [&](int k) { return static_cast<std::uint64_t>(10 * seed + k); };
    SlowNoise x(kSigma_m, 2.0, kRate_hz, of(0)), y(kSigma_m, 2.0, kRate_hz, of(1));
    for (int i = 0; i <= 6000; ++i) {
      const double t = i / kRate_hz;
      t_s.push_back(t);
      u_m.emplace_back(0.02 * (std::min(t, 2.0) + std::max(0.0, t - 4.0)) + x.next(), y.next());
    }
    ArcLengthConfig config;
    config.noise_m = kSigma_m;
    config.bend_m = 5.0 * kSigma_m;
    const ArcLength arc = measure_arc_length(t_s, u_m, {}, config);
    EXPECT_NEAR(arc.s_m.back(), 0.08, 4.0 * std::numbers::sqrt2 * kSigma_m) << seed;
    EXPECT_TRUE(arc.turning_points.empty()) << seed;
  }
}

// Where the tip stops and starts, the low-pass moves the path along itself. That was taken for a bend, and the
// direction there followed the noise: 0.4 mm more of 75 with five stops.
TEST(ArcLength, RestsOnTheWayOfAStraightPathDoNotLengthenIt) {
  constexpr double kSigma_m = 0.15e-3;
  constexpr int kSeeds = 16;
  double sum_m = 0.0;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    std::vector<double> t_s;
    std::vector<Eigen::Vector2d> u_m;
    const auto of = [&](int k) { return static_cast<std::uint64_t>(10 * seed + k); };
    SlowNoise x(kSigma_m, 3.0, kRate_hz, of(0)), y(kSigma_m, 3.0, kRate_hz, of(1));
    double true_m = 0.0;
    for (int i = 0; i <= 8000; ++i) {
      // 0.6 s at 25 mm/s and 0.9 s of rest in turn.
      const double phase_s = std::fmod(i / kRate_hz, 1.5);
      if (phase_s > 0.9) true_m += 0.025 / kRate_hz;
      t_s.push_back(i / kRate_hz);
      u_m.emplace_back(true_m + x.next(), y.next());
    }
    ArcLengthConfig config;
    config.noise_m = kSigma_m;
    config.bend_m = 5.0 * kSigma_m;
    sum_m += measure_arc_length(t_s, u_m, {}, config).s_m.back() - true_m;
  }
  // Errors of two ends of σ each: three standard errors of the mean.
  EXPECT_LT(std::abs(sum_m) / kSeeds, 3.0 * std::numbers::sqrt2 * kSigma_m / std::sqrt(static_cast<double>(kSeeds)));
}

// In a hole the tip slides on while the hand rests. Its path begins where it first was and ends where it is at last.
TEST(ArcLength, ATipThatCreepsDuringItsRestsIsOnItsWay) {
  constexpr double kSigma_m = 0.02e-3, kCreep_m = 0.4e-3;
  double sum_m = 0.0;
  constexpr int kSeeds = 8;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    const double from_s = seed % 2 == 0 ? 0.7 : 0.1;
    std::vector<double> t_s;
    std::vector<Eigen::Vector2d> u_m;
    const auto of = [&](int k) { return static_cast<std::uint64_t>(10 * seed + k); };
    SlowNoise x(kSigma_m, 3.0, kRate_hz, of(0)), y(kSigma_m, 3.0, kRate_hz, of(1));
    double true_m = 0.0;
    for (int i = 0; i <= 6000; ++i) {
      const double t = i / kRate_hz;
      true_m = 0.02 * std::clamp(t - 2.0, 0.0, 2.0);
      // 0.4 mm in half a second of each rest of 2 s.
      true_m += kCreep_m * std::clamp((t - from_s) / 0.5, 0.0, 1.0) + kCreep_m * std::clamp((t - 4.7) / 0.5, 0.0, 1.0);
      t_s.push_back(t);
      u_m.emplace_back(true_m + x.next(), y.next());
    }
    ArcLengthConfig config;
    config.noise_m = kSigma_m;
    config.bend_m = 5.0 * kSigma_m;
    sum_m += measure_arc_length(t_s, u_m, {}, config).s_m.back() - true_m;
  }
  EXPECT_LT(std::abs(sum_m) / kSeeds, 3.0 * std::numbers::sqrt2 * kSigma_m / std::sqrt(static_cast<double>(kSeeds)));
}

// Two lines of 40 mm joined by a half circle of 1.25 mm, as a raster turns: the point after a way along it.
constexpr double kLine_m = 0.04, kTurnRadius_m = 1.25e-3, kRaster_m = 2.0 * kLine_m + std::numbers::pi * kTurnRadius_m;

Eigen::Vector2d raster_at(double s_m) {
  if (s_m < kLine_m) return {s_m, 0.0};
  const double past_m = s_m - kRaster_m + kLine_m;
  if (past_m > 0.0) return {kLine_m - past_m, 2.0 * kTurnRadius_m};
  const double angle = (s_m - kLine_m) / kTurnRadius_m;
  return {kLine_m + kTurnRadius_m * std::sin(angle), kTurnRadius_m * (1.0 - std::cos(angle))};
}

ArcLength measure_raster(double noise_m, double tremor_m) {
  constexpr double kSpeed_mps = 0.025, kRest_s = 0.6;
  Random random(7);
  std::vector<double> t_s;
  std::vector<Eigen::Vector2d> u_m;
  for (int i = 0; i < static_cast<int>((kRaster_m / kSpeed_mps + 2.0 * kRest_s) * kRate_hz); ++i) {
    t_s.push_back(i / kRate_hz);
    const double way_m = std::clamp(kSpeed_mps * (t_s.back() - kRest_s), 0.0, kRaster_m);
    const double x_m = noise_m * random.normal(), y_m = noise_m * random.normal();
    const double tremor = tremor_m * std::sin(2.0 * std::numbers::pi * 9.0 * t_s.back());
    u_m.emplace_back(raster_at(way_m) + Eigen::Vector2d(x_m, y_m + tremor));
  }
  ArcLengthConfig config;
  config.noise_m = 0.05e-3;
  config.bend_m = 5.0 * config.noise_m;
  return measure_arc_length(t_s, u_m, {}, config);
}

// The quick low-pass cuts such a turn, and made it 80 to 100 µm shorter; what is added counts as an error by half.
TEST(ArcLength, TheTurnsOfARasterAreFollowed) {
  for (const double noise_m : {0.0, 20e-6}) {
    for (const double tremor_m : {0.0, 30e-6}) {
      const ArcLength arc = measure_raster(noise_m, tremor_m);
      EXPECT_NEAR(arc.s_m.back(), kRaster_m, 35e-6) << noise_m << ' ' << tremor_m;
      EXPECT_NEAR(arc.s_m.back(), kRaster_m, arc.bends_m) << noise_m << ' ' << tremor_m;
      EXPECT_LT(arc.bends_m, 0.2e-3) << noise_m << ' ' << tremor_m;
    }
  }
}

// Rows that are closer together than noise: what is between them is cut by less than a bend, but a reversal is certain.
// Two of them end where they began, and are no noise.
TEST(ArcLength, RowsThatAreCloserThanNoiseAreFollowed) {
  constexpr double kRow_m = 0.019, kSpeed_mps = 0.025, kRest_s = 0.6, kSigma_m = 0.1e-3;
  constexpr int kRows = 6, kSeeds = 6;
  for (const double radius_m : {0.1e-3, 0.3e-3}) {
    const double turn_m = std::numbers::pi * radius_m, period_m = kRow_m + turn_m;
    const double true_m = kRows * period_m - turn_m;
    double sum_m = 0.0;
    for (int seed = 1; seed <= kSeeds; ++seed) {
      const auto of = [&](int k) { return static_cast<std::uint64_t>(10 * seed + k); };
      SlowNoise x(kSigma_m, 3.0, kRate_hz, of(0)), y(kSigma_m, 3.0, kRate_hz, of(1));
      std::vector<double> t_s;
      std::vector<Eigen::Vector2d> u_m;
      for (int i = 0; i < static_cast<int>((true_m / kSpeed_mps + 2.0 * kRest_s) * kRate_hz); ++i) {
        t_s.push_back(i / kRate_hz);
        const double way_m = std::clamp(kSpeed_mps * (t_s.back() - kRest_s), 0.0, true_m);
        const int row = std::min(static_cast<int>(way_m / period_m), kRows - 1);
        const double in_row_m = way_m - row * period_m, angle = std::max(0.0, in_row_m - kRow_m) / radius_m;
        const double reach_m = in_row_m < kRow_m ? in_row_m : kRow_m + radius_m * std::sin(angle);
        const double aside_m = 2.0 * radius_m * row + (in_row_m < kRow_m ? 0.0 : radius_m * (1.0 - std::cos(angle)));
        u_m.emplace_back((row % 2 == 0 ? reach_m : kRow_m - reach_m) + x.next(), aside_m + y.next());
      }
      ArcLengthConfig config;
      config.noise_m = kSigma_m;
      config.bend_m = 5.0 * kSigma_m;
      const double error_m = measure_arc_length(t_s, u_m, {}, config).s_m.back() - true_m;
      EXPECT_NEAR(error_m, 0.0, 1.5e-3) << radius_m << ' ' << seed;  // a row is 19 mm
      sum_m += error_m;
    }
    // What is sharper than the noise is rounded by it: at most σ a reversal, and that of the two ends.
    EXPECT_NEAR(sum_m / kSeeds, 0.0, (kRows - 1) * kSigma_m + 3.0 * kSigma_m * std::sqrt(2.0 / kSeeds)) << radius_m;
  }
}

// Corners at which the tip only slows down are bends, of which little is cut.
TEST(ArcLength, FollowsAZigzag) {
  std::vector<double> t_s;
  std::vector<Eigen::Vector2d> u_m;
  double true_m = 0.0;
  Eigen::Vector2d at(0.0, 0.0);
  for (int i = 0; i <= 6000; ++i) {
    // Six legs of 20 mm at right angles, with (1 − cos) speeds.
    const int leg = std::min(5, i / 1000);
    const double step_m = 0.02 * (1.0 - std::cos(2.0 * std::numbers::pi * (i % 1000) / 1000.0)) / kRate_hz;
    true_m += step_m;
    at += step_m * (leg % 2 == 0 ? Eigen::Vector2d::UnitX() : Eigen::Vector2d::UnitY());
    t_s.push_back(i / kRate_hz);
    u_m.push_back(at);
  }
  ArcLengthConfig config;
  config.noise_m = 0.05e-3;
  config.bend_m = 0.25e-3;
  EXPECT_NEAR(measure_arc_length(t_s, u_m, {}, config).s_m.back(), true_m, 0.15e-3);
}

TEST(ArcLength, FollowsAnArcWithRests) {
  // The stroke bent to a radius of 60 mm.
  Stroke stroke = make_stroke();
  for (std::size_t i = 0; i < stroke.t_s.size(); ++i) {
    const double a = stroke.true_m[i] / 0.06;
    stroke.u_m[i] = 0.06 * Eigen::Vector2d(std::sin(a), 1.0 - std::cos(a));
  }
  for (const double noise_m : {0.0, 0.05e-3}) {
    ArcLengthConfig config;
    config.noise_m = noise_m;
    EXPECT_NEAR(measure_arc_length(stroke.t_s, stroke.u_m, {}, config).s_m.back(), kWay_m, 1e-3 * kWay_m) << noise_m;
  }
}

}  // namespace
}  // namespace asperity
