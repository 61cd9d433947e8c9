#include <cmath>
#include <ctime>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include <Eigen/Core>

#include "asperity/base/error.h"
#include "asperity/base/random.h"
#include "asperity/profile/find_periodicity_under_noise.h"
#include "asperity/profile/unroll_path.h"

namespace asperity {
namespace {

constexpr double kSpacing_m = 0.05e-3;
constexpr std::size_t kPoints = 1600;  // 80 mm
constexpr double kTwoPi = 2.0 * std::numbers::pi;

// An arc of 80 mm that turns by this angle, its chord along x.
std::vector<Eigen::Vector2d> arc(double turn_rad) {
  const double radius_m = kSpacing_m * static_cast<double>(kPoints - 1) / turn_rad;
  std::vector<Eigen::Vector2d> out;
  for (std::size_t i = 0; i < kPoints; ++i) {
    const double angle = kSpacing_m * static_cast<double>(i) / radius_m - 0.5 * turn_rad;
    out.emplace_back(radius_m * std::sin(angle), radius_m * std::cos(angle));
  }
  return out;
}

TextureNoise white_noise(double rms_m) {
  TextureNoise out;
  const double highest = 0.5e-3 / kSpacing_m;
  out.frequency_cycles_per_mm = {0.0, highest};
  out.added_psd_m2_mm = {rms_m * rms_m / highest, rms_m * rms_m / highest};
  out.misplaced_psd_m2_mm = {0.0, 0.0};
  out.added_rms_m = out.noise_rms_m = rms_m;
  out.added_rms_stderr_m = out.noise_rms_stderr_m = 0.05 * rms_m;
  return out;
}

std::vector<double> ribs(const std::vector<Eigen::Vector2d>& path_m, double pitch_m, double turned_rad, double noise_m,
                         std::uint64_t seed) {
  Random random(seed);
  const double phase = kTwoPi * random.uniform();
  std::vector<double> out;
  for (const Eigen::Vector2d& p_m : path_m) {
    const double u_m = std::cos(turned_rad) * p_m.x() + std::sin(turned_rad) * p_m.y();
    out.push_back(10e-6 * std::sin(kTwoPi * u_m / pitch_m + phase) + noise_m * random.normal());
  }
  return out;
}

TEST(BentPathPeriodicity, RibsOnAnArcAreFoundWhereThePathIsKnown) {
  constexpr double kNoise_m = 5e-6;
  const std::vector<Eigen::Vector2d> path_m = arc(0.9);
  double square = 0.0, count = 0.0;
  int found = 0, found_along = 0;
  for (const double turned_rad : {0.0, 0.3, -0.5}) {
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
      constexpr double kPitch_m = 1.1e-3;
      const std::vector<double> h = ribs(path_m, kPitch_m, turned_rad, kNoise_m, seed);
      found_along += find_periodicity_under_noise(h, kSpacing_m, white_noise(kNoise_m), {}).periodic ? 1 : 0;
      const Periodicity p = find_periodicity_under_noise(h, kSpacing_m, white_noise(kNoise_m), {}, path_m);
      found += p.periodic ? 1 : 0;
      if (!std::isfinite(p.across_pitch_m)) continue;
      square += std::pow((p.across_pitch_m - kPitch_m) / p.across_pitch_stderr_m, 2.0);
      count += 1.0;
      // Along the path every period is longer, by the cosine of an angle of up to 0.95 rad.
      EXPECT_GT(p.pitch_m, 0.99 * kPitch_m);
      EXPECT_LT(p.pitch_m, kPitch_m / std::cos(0.95));
      // Half of the turn to each side of the ribs' normal: the cosine's spread over that, 3 to 20 %.
      EXPECT_GT(p.pitch_stderr_m, 0.02 * p.pitch_m);
      EXPECT_LT(p.pitch_stderr_m, 0.25 * p.pitch_m);
    }
  }
  EXPECT_EQ(found, 12);
  EXPECT_LE(found_along, 3);
  ASSERT_GE(count, 9.0);
  EXPECT_LT(std::sqrt(square / count), 2.0);  // of a dozen: 1.4 with a probability of some thousandths
}

TEST(BentPathPeriodicity, AStraightPathChangesNothing) {
  std::vector<Eigen::Vector2d> path_m;
  for (std::size_t i = 0; i < kPoints; ++i) {
    const double x_m = kSpacing_m * static_cast<double>(i);
    path_m.emplace_back(x_m, 0.3e-3 * std::sin(x_m / 5e-3));
  }
  const std::vector<double> h = ribs(path_m, 2e-3, 0.0, 4e-6, 5);
  const Periodicity with = find_periodicity_under_noise(h, kSpacing_m, white_noise(4e-6), {}, path_m);
  const Periodicity without = find_periodicity_under_noise(h, kSpacing_m, white_noise(4e-6), {});
  EXPECT_TRUE(with.periodic);
  EXPECT_EQ(with.pitch_m, without.pitch_m);
  EXPECT_EQ(with.pitch_stderr_m, without.pitch_stderr_m);
  EXPECT_TRUE(std::isnan(with.across_pitch_m));
}

TEST(BentPathPeriodicity, NoiseOnAnArcHasNoPattern) {
  const std::vector<Eigen::Vector2d> path_m = arc(0.9);
  int found = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    Random random(seed);
    std::vector<double> h(kPoints);
    double x = 0.0;
    for (double& height_m : h) height_m = x = 0.85 * x + 5e-6 * random.normal();
    found += find_periodicity_under_noise(h, kSpacing_m, white_noise(1e-7), {}, path_m).periodic ? 1 : 0;
  }
  EXPECT_LE(found, 2);  // at 1 % each, three of forty have a probability of 0.8 %
}

// Round holes with a smooth rim on a square lattice, turned from the chord.
std::vector<double> holes(const std::vector<Eigen::Vector2d>& path_m, double pitch_m, double turned_rad, double noise_m,
                          std::uint64_t seed) {
  Random random(seed, 3);
  const double c = std::cos(turned_rad), s = std::sin(turned_rad);
  const Eigen::Vector2d from_m(pitch_m * random.uniform(), pitch_m * random.uniform());
  std::vector<double> out;
  for (const Eigen::Vector2d& p_m : path_m) {
    const Eigen::Vector2d at_m = Eigen::Vector2d(c * p_m.x() + s * p_m.y(), c * p_m.y() - s * p_m.x()) + from_m;
    const double r = std::hypot(std::remainder(at_m.x(), pitch_m), std::remainder(at_m.y(), pitch_m)) / (0.3 * pitch_m);
    out.push_back((r < 1.0 ? -100e-6 * (1.0 - r * r) : 0.0) + noise_m * random.normal());
  }
  return out;
}

TEST(BentPathPeriodicity, ALatticeUnderAnArcIsFound) {
  constexpr double kNoise_m = 10e-6;
  const std::vector<Eigen::Vector2d> path_m = arc(0.8);
  double square = 0.0, count = 0.0;
  int found = 0;
  for (const double turned_rad : {0.0, 0.2, 0.6}) {
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
      const double pitch_m = 2.1e-3 + 0.2e-3 * static_cast<double>(seed);
      const std::vector<double> h = holes(path_m, pitch_m, turned_rad, kNoise_m, seed);
      const Periodicity p = find_periodicity_under_noise(h, kSpacing_m, white_noise(kNoise_m), {}, path_m);
      found += p.periodic ? 1 : 0;
      if (!p.periodic || !std::isfinite(p.across_pitch_m)) continue;
      square += std::pow((p.across_pitch_m - pitch_m) / p.across_pitch_stderr_m, 2.0);
      count += 1.0;
    }
  }
  EXPECT_EQ(found, 12);
  ASSERT_GE(count, 9.0);
  EXPECT_LT(std::sqrt(square / count), 2.0);
}

// Plane waves in all directions, of lengths of 0.7 to 4 mm: an isotropic surface, whose profile is random.
TEST(BentPathPeriodicity, ARandomReliefUnderAnArcHasNoLattice) {
  const std::vector<Eigen::Vector2d> path_m = arc(0.8);
  int found = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    Random random(seed, 4);
    std::vector<double> h(kPoints, 0.0);
    for (int wave = 0; wave < 400; ++wave) {
      const double per_m = 250.0 * std::pow(6.0, random.uniform()), way = kTwoPi * random.uniform();
      const double phase = kTwoPi * random.uniform();
      const Eigen::Vector2d g(per_m * std::cos(way), per_m * std::sin(way));
      for (std::size_t i = 0; i < kPoints; ++i) h[i] += 1e-6 * std::cos(kTwoPi * g.dot(path_m[i]) + phase);
    }
    found += find_periodicity_under_noise(h, kSpacing_m, white_noise(1e-7), {}, path_m).periodic ? 1 : 0;
  }
  EXPECT_LE(found, 2);
}

// A wild path of 10 m whose bend is 1.1 m: 15,000 directions of 200,000 heights each took hours.
TEST(BentPathPeriodicity, ALongPathIsSearchedInBoundedTime) {
  constexpr std::size_t kMany = 200'000;
  std::vector<Eigen::Vector2d> path_m;
  std::vector<double> h;
  Random random(4);
  for (std::size_t i = 0; i < kMany; ++i) {
    const double angle = 0.9 * (static_cast<double>(i) / static_cast<double>(kMany) - 0.5);
    const double radius_m = kSpacing_m * static_cast<double>(kMany) / 0.9;
    path_m.emplace_back(radius_m * std::sin(angle), radius_m * std::cos(angle));
    h.push_back(5e-6 * random.normal());
  }
  const std::clock_t start = std::clock();
  EXPECT_FALSE(find_periodicity_under_noise(h, kSpacing_m, white_noise(5e-6), {}, path_m).periodic);
  EXPECT_LT(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC, 120.0);
}

// A dead sensor: the climb to a lattice's highest power never ended where all powers are 0.
TEST(BentPathPeriodicity, HeightsOfZeroHaveNone) {
  const std::vector<double> flat(kPoints, 0.0), level(kPoints, 1e-3);
  EXPECT_FALSE(find_periodicity_under_noise(flat, kSpacing_m, white_noise(5e-6), {}, arc(0.8)).periodic);
  EXPECT_FALSE(find_periodicity_under_noise(level, kSpacing_m, white_noise(5e-6), {}, arc(0.8)).periodic);
}

TEST(BentPathPeriodicity, NeedsAPointForEachHeight) {
  const std::vector<double> h(kPoints, 0.0);
  EXPECT_THROW(find_periodicity_under_noise(h, kSpacing_m, white_noise(1e-6), {}, std::vector<Eigen::Vector2d>(3)),
               Error);
}

// A path on a cylinder of radius r: x along its axis, y round it; on the sheet a wave.
TEST(UnrollPath, APathOnACylinderIsThatOnTheSheet) {
  constexpr double kRadius_m = 15e-3;
  BasePath path;
  std::vector<Eigen::Vector2d> sheet_m;
  double s_m = 0.0;
  for (int i = 0; i < 8000; ++i) {
    const double y_m = 10e-6 * i, x_m = 6e-3 * std::sin(y_m / 15e-3);
    if (i > 0) s_m += (Eigen::Vector2d(x_m, y_m) - sheet_m.back()).norm();
    sheet_m.emplace_back(x_m, y_m);
    const double angle = y_m / kRadius_m;
    path.p_world_m.emplace_back(x_m, kRadius_m * std::sin(angle), kRadius_m * std::cos(angle));
    path.n_world.emplace_back(0.0, std::sin(angle), std::cos(angle));
    path.s_m.push_back(s_m);
  }
  const std::vector<Eigen::Vector2d> flat_m = unroll_path(path, path.s_m);
  ASSERT_EQ(flat_m.size(), sheet_m.size());
  // Distances between points are those of the sheet: pieces of 1 mm are chords, 2e-4 shorter where the body is round.
  for (const std::size_t a : {0u, 1500u, 4000u}) {
    for (const std::size_t b : {2500u, 6000u, 7900u}) {
      const double expected = (sheet_m[a] - sheet_m[b]).norm();
      EXPECT_NEAR((flat_m[a] - flat_m[b]).norm(), expected, 2e-3 * expected + 20e-6);
    }
  }
  EXPECT_TRUE(unroll_path(BasePath{}, path.s_m).empty());
  // Lengths on the surface above the tip's path make a larger sheet.
  for (double& s : path.s_m) s *= 1.02;
  const std::vector<Eigen::Vector2d> above_m = unroll_path(path, path.s_m);
  EXPECT_NEAR((above_m[7900] - above_m[0]).norm(), 1.02 * (sheet_m[7900] - sheet_m[0]).norm(), 4e-3 * 0.08);
}

}  // namespace
}  // namespace asperity
