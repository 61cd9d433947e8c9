#include "asperity/profile/find_base_path.h"

#include <gtest/gtest.h>

#include "asperity/base/error.h"
#include "synthetic_path.h"

namespace asperity {
namespace {

using namespace synthetic;

constexpr double kDegree_rad = 3.14159265358979323846 / 180.0;

double worst_angle_deg(const BasePathResult& result, const Scan& scan) {
  double worst = 0.0;
  for (std::size_t i = 0; i < scan.normal.size(); ++i) {
    worst = std::max(worst, std::acos(std::clamp(result.path.n_world[i].dot(scan.normal[i]), -1.0, 1.0)) / kDegree_rad);
  }
  return worst;
}

void expect_length(const BasePathResult& result, const Scan& scan, double percent) {
  const double s = scan.s_m.back() - scan.s_m.front();
  EXPECT_NEAR(result.length_m / s, 1.0, 0.01 * percent) << "length " << result.length_m << " of " << s;
}

TEST(BasePath, CurvedPathOverAFlatObjectGivesThePlanesNormal) {
  const Scan scan = make_scan(arc_on_plane(0.08, 0.025), sine(0.47e-3, 2.5e-3), {.probe_lean = {0.2, -0.1, 0.1}});
  const BasePathResult result = find_base_path(scan.motion, scan.tip_in_marker_m, {});
  EXPECT_EQ(result.shape, PathShape::kPlane);
  EXPECT_GT(result.shape_probability, 0.95);
  EXPECT_LT(worst_angle_deg(result, scan), 1.0);
  EXPECT_TRUE(result.undetermined.empty());
  expect_length(result, scan, 0.1);
}

TEST(BasePath, ATextureOfDeepHolesDoesNotLengthenThePath) {
  // The path itself is 1.29 times as long (erratum 23).
  const Scan scan =
      make_scan(arc_on_plane(0.1, 0.025), sine(0.94e-3, 2.5e-3), {.slow_sigma_m = 0.1e-3, .fine_sigma_m = 2e-6});
  const BasePathResult result = find_base_path(scan.motion, scan.tip_in_marker_m, {});
  EXPECT_EQ(result.shape, PathShape::kPlane);
  expect_length(result, scan, 0.5);
}

TEST(BasePath, LengthHoldsOverSeedsSpeedsAndNoise) {
  double worst = 0.0;
  for (const double speed : {0.020, 0.025, 0.045}) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      const Scan scan =
          make_scan(arc_on_plane(0.08, speed), sine(0.3e-3, 2.5e-3),
                    {.rate_hz = 1000.0, .duration_s = 6.0, .slow_sigma_m = 0.1e-3, .fine_sigma_m = 3e-6, .seed = seed});
      const BasePathResult result = find_base_path(scan.motion, scan.tip_in_marker_m, {});
      worst = std::max(worst, std::abs(result.length_m / scan.s_m.back() - 1.0));
    }
  }
  EXPECT_LT(worst, 0.006);  // the ends' errors alone are 0.14 mm of 120 mm, three standard deviations 0.35 %
}

TEST(BasePath, SampleNoiseDoesNotLengthenThePath) {
  // Sums of steps would give 4000 Hz · 0.05 mm a second, eight times the true length.
  const Scan scan = make_scan(arc_on_plane(0.08, 0.025), sine(0.1e-3, 2.5e-3), {.fine_sigma_m = 0.05e-3});
  expect_length(find_base_path(scan.motion, scan.tip_in_marker_m, {}), scan, 0.3);
}

TEST(BasePath, StraightStrokeTakesTheProbesAxisAndSaysSo) {
  const auto straight =
      on_plane([](double t) { return Eigen::Vector2d(0.025 * t, 0.0); }, [](double t) { return 0.025 * t; });
  BasePathConfig config;
  config.texture_axis_sigma_deg = 0.0;
  const Scan scan = make_scan(straight, sine(0.47e-3, 2.5e-3), {.slow_sigma_m = 0.05e-3});
  const BasePathResult result = find_base_path(scan.motion, scan.tip_in_marker_m, config);
  EXPECT_EQ(result.shape, PathShape::kPlane);
  EXPECT_LT(worst_angle_deg(result, scan), 8.0);
  ASSERT_EQ(result.undetermined.size(), 1u);
  EXPECT_NEAR(result.undetermined[0].sigma_deg, 20.0, 7.0);  // the prior's own, as the path says next to nothing
}

TEST(BasePath, FineMotionFixesTheNormalOfAStraightStroke) {
  const auto straight =
      on_plane([](double t) { return Eigen::Vector2d(0.025 * t, 0.0); }, [](double t) { return 0.025 * t; });
  // Leaning 20° sideways, across the stroke.
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.6, Eigen::Vector3d(1.0, 0.4, -0.3).normalized()));
  const Scan scan = make_scan(straight, sine(0.47e-3, 1.2e-3),
                              {.slow_sigma_m = 0.05e-3, .probe_lean = turn * Eigen::Vector3d(0.0, 0.364, 0.0)});
  BasePathConfig config;
  const double with = worst_angle_deg(find_base_path(scan.motion, scan.tip_in_marker_m, config), scan);
  config.texture_axis_sigma_deg = 0.0;
  const double without = worst_angle_deg(find_base_path(scan.motion, scan.tip_in_marker_m, config), scan);
  EXPECT_LT(with, 6.0);
  EXPECT_GT(without, 10.0);
}

TEST(BasePath, BodyOfRevolutionHasNormalsInThePlaneOfThePath) {
  for (const bool outside : {true, false}) {
    const Scan scan = make_scan(across_cylinder(0.045, 0.025, outside), sine(0.1e-3, 0.8e-3),
                                {.duration_s = 4.0, .slow_sigma_m = 0.05e-3});
    const BasePathResult result = find_base_path(scan.motion, scan.tip_in_marker_m, {});
    EXPECT_EQ(result.shape, PathShape::kCircle);
    EXPECT_EQ(result.outside, outside);
    EXPECT_GT(result.shape_probability, 0.95);
    EXPECT_NEAR(result.radius_m, 0.045, 4.0 * result.radius_stderr_m);
    EXPECT_LT(worst_angle_deg(result, scan),
              5.0);  // a radius off by a millimetre turns the ends by one degree, the axis the rest
    expect_length(result, scan, 0.7);
  }
}

TEST(BasePath, APathThatAlsoMovesAlongTheAxisIsOnACylinder) {
  // Across the cylinder and 8 mm along it and back, as a person who sways does.
  const auto base = [](double t) {
    const double a = 0.025 * t / 0.05 - 1.0, z = 0.008 * std::cos(0.5 * std::numbers::pi * a);
    const Eigen::Vector3d radial(std::cos(a), std::sin(a), 0.0);
    return Point{0.05 * radial + Eigen::Vector3d(0.0, 0.0, z), radial, 0.025 * t};
  };
  const Scan scan = make_scan(base, sine(0.1e-3, 0.8e-3), {.duration_s = 4.0, .slow_sigma_m = 0.02e-3});
  const BasePathResult result = find_base_path(scan.motion, scan.tip_in_marker_m, {});
  EXPECT_EQ(result.shape, PathShape::kCircle);
  EXPECT_NEAR(result.radius_m, 0.05, 2e-3);
  EXPECT_LT(std::acos(std::abs(result.axis_world.z())) / kDegree_rad, 8.0);  // the plane of the path leans by 25
}

// Rows of 25 mm, half circles between them, around the cylinder or along its axis: the path lies in no plane, and the
// one that fits it best is off by 0.5 mm.
TEST(BasePath, ARasterOnACylinderIsRound) {
  constexpr double kRadius_m = 0.045, kRow_m = 0.025, kTurn_m = 1.25e-3, kSpeed_mps = 0.025;
  constexpr int kRows = 8;
  constexpr double kPeriod_m = kRow_m + std::numbers::pi * kTurn_m;
  for (const bool around : {true, false}) {
    const auto base = [&](double t) {
      const double s_m = kSpeed_mps * t;
      const int row = static_cast<int>(s_m / kPeriod_m);
      const double in_row_m = s_m - row * kPeriod_m, angle = std::max(0.0, in_row_m - kRow_m) / kTurn_m;
      const double reach_m = in_row_m < kRow_m ? in_row_m : kRow_m + kTurn_m * std::sin(angle);
      const double u = (row % 2 == 0 ? reach_m : kRow_m - reach_m) - 0.5 * kRow_m;
      const double v = 2.0 * kTurn_m * (row - 0.5 * kRows) + kTurn_m * (1.0 - std::cos(angle));
      const double a = (around ? u : v) / kRadius_m;
      const Eigen::Vector3d radial(std::cos(a), std::sin(a), 0.0);
      return Point{kRadius_m * radial + Eigen::Vector3d(0.0, 0.0, around ? v : u), radial, s_m};
    };
    Scan scan = make_scan(base, sine(0.02e-3, 0.8e-3),
                          {.duration_s = (kRows * kPeriod_m - 0.01) / kSpeed_mps, .slow_sigma_m = 0.05e-3});
    scan.motion.cov_world_tip_m2.assign(scan.motion.size(), 0.05e-3 * 0.05e-3 * Eigen::Matrix3d::Identity());
    const BasePathResult result = find_base_path(scan.motion, scan.tip_in_marker_m, {});
    EXPECT_EQ(result.shape, PathShape::kCircle) << around;
    EXPECT_NEAR(result.radius_m, kRadius_m, 4.0 * result.radius_stderr_m) << around;
    EXPECT_LT(result.radius_stderr_m, 5e-3) << around;
    EXPECT_LT(std::acos(std::min(1.0, std::abs(result.axis_world.z()))) / kDegree_rad, 5.0) << around;
    // A radius that is off by 2 mm turns the normals by 0.7 degrees at 12 mm from the middle, the axis by the rest.
    EXPECT_LT(worst_angle_deg(result, scan), 4.0) << around;
    expect_length(result, scan, 0.7);
  }
}

// The same rows on a plane stay on one.
TEST(BasePath, ARasterOnAPlaneIsFlat) {
  constexpr double kRow_m = 0.025, kSpacing_m = 2.5e-3, kSpeed_mps = 0.025;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const auto base = on_plane(
        [&](double t) {
          const double s_m = kSpeed_mps * t;
          const int row = static_cast<int>(s_m / kRow_m);
          const double in_row_m = s_m - row * kRow_m;
          // Rows that lean a little, as a zigzag: no gap between them.
          return Eigen::Vector2d(row % 2 == 0 ? in_row_m : kRow_m - in_row_m, kSpacing_m * s_m / kRow_m);
        },
        [&](double t) { return kSpeed_mps * t * std::hypot(1.0, kSpacing_m / kRow_m); });
    const Scan scan =
        make_scan(base, sine(0.02e-3, 0.8e-3), {.duration_s = 7.5, .slow_sigma_m = 0.05e-3, .seed = seed});
    const BasePathResult result = find_base_path(scan.motion, scan.tip_in_marker_m, {});
    EXPECT_EQ(result.shape, PathShape::kPlane) << seed;
    EXPECT_LT(worst_angle_deg(result, scan), 2.0) << seed;
  }
}

TEST(BasePath, BackAndForthKeepsGrowingAndMarksTheTurns) {
  // 40 mm strokes with a bow, sinusoidal in time: five turns in 6 s.
  const auto x = [](double t) { return 0.02 * (1.0 - std::cos(2.0 * std::numbers::pi * t / 2.4)); };
  const auto s = [](double t) {
    const double half = std::floor(t / 1.2), rest = t - 1.2 * half;
    return 0.04 * half + 0.02 * (1.0 - std::cos(std::numbers::pi * rest / 1.2));
  };
  const auto lateral = [](double t) { return 0.002 * t; };
  const Scan scan = make_scan(on_plane([=](double t) { return Eigen::Vector2d(x(t), lateral(t)); }, s),
                              sine(0.1e-3, 2.5e-3), {.duration_s = 6.0, .slow_sigma_m = 0.02e-3});
  const BasePathResult result = find_base_path(scan.motion, scan.tip_in_marker_m, {});
  EXPECT_EQ(result.turning_points.size(), 4u);
  for (std::size_t k = 0; k < result.turning_points.size(); ++k) {
    EXPECT_NEAR(static_cast<double>(scan.motion.t_ns[result.turning_points[k]]) * 1e-9,
                1.2 * static_cast<double>(k + 1), 0.03);
  }
  EXPECT_NEAR(result.length_m, 0.2, 0.01 * 0.2);
}

TEST(BasePath, RestDoesNotCreep) {
  // Two seconds of motion, three at rest, two of motion.
  const auto x = [](double t) { return 0.025 * (t < 2.0 ? t : t < 5.0 ? 2.0 : t - 3.0); };
  const auto base = on_plane([=](double t) { return Eigen::Vector2d(x(t), 0.01 * std::sin(20.0 * x(t))); }, x);
  const Scan scan =
      make_scan(base, sine(0.1e-3, 2.5e-3), {.duration_s = 7.0, .slow_sigma_m = 0.1e-3, .fine_sigma_m = 5e-6});
  const BasePathResult result = find_base_path(scan.motion, scan.tip_in_marker_m, {});
  const auto at = [&](double t) { return result.path.s_m[static_cast<std::size_t>(t * 4000.0)]; };
  EXPECT_NEAR(at(4.8) - at(2.3), 0.0, 0.35e-3);  // the slow error's own change, 2.5 of its standard deviations
}

TEST(BasePath, ApproachAndLiftAreNotPartOfIt) {
  Scan scan = make_scan(arc_on_plane(0.08, 0.025), sine(0.2e-3, 2.5e-3), {.duration_s = 6.0});
  for (std::size_t i = 0; i < scan.motion.size(); ++i) {
    const double t = static_cast<double>(i) / 4000.0;
    const double lift = t < 0.5 ? 0.02 * (0.5 - t) : t > 5.5 ? 0.02 * (t - 5.5) : 0.0;
    scan.motion.p_world_tip_m[i] += lift * scan.normal[i];
    scan.motion.force_N[i] = lift > 0.0 ? 0.0 : i % 8 == 0 ? 1.0 : NAN;
  }
  for (const bool with_force : {true, false}) {
    if (!with_force) scan.motion.force_N.assign(scan.motion.size(), NAN);
    const BasePathResult result = find_base_path(scan.motion, scan.tip_in_marker_m, {});
    EXPECT_EQ(result.shape, PathShape::kPlane);
    EXPECT_LT(worst_angle_deg(result, scan), 1.0) << with_force;
    EXPECT_NEAR(result.length_m, 0.125, with_force ? 0.001 : 0.025) << with_force;
  }
}

TEST(BasePath, FreeFormTakesTheCurve) {
  // A saddle-like path whose height under the texture waves by 8 mm over 120 mm.
  const auto base = [](double t) {
    const double x = 0.025 * t, k = 2.0 * std::numbers::pi / 0.12;
    const Eigen::Vector3d tangent =
        Eigen::Vector3d(1.0, 0.02 * k * std::cos(0.7 * k * x), -0.004 * k * std::sin(k * x));
    const Eigen::Vector3d n =
        (Eigen::Vector3d::UnitZ() - Eigen::Vector3d::UnitZ().dot(tangent.normalized()) * tangent.normalized())
            .normalized();
    return Point{{x, 0.02 / 0.7 * std::sin(0.7 * k * x), 0.004 * std::cos(k * x)}, n, x};
  };
  const Scan scan = make_scan(base, sine(0.1e-3, 2.5e-3), {.duration_s = 8.0});
  const BasePathResult result = find_base_path(scan.motion, scan.tip_in_marker_m, {});
  EXPECT_EQ(result.shape, PathShape::kCurve);
  double square = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 4000; i + 4000 < scan.motion.size(); ++i) {
    const double h = result.path.n_world[i].dot(scan.motion.p_world_tip_m[i] - result.path.p_world_m[i]);
    square += std::pow(h - scan.height_m[i], 2);
    ++count;
  }
  // What the base takes from waves of 120 mm at a cut-off of 50 mm, 4 mm · (0.42·0.8)⁴.
  EXPECT_LT(std::sqrt(square / static_cast<double>(count)), 0.06e-3);
}

TEST(BasePath, RefusesWhatItCannotUse) {
  Scan scan = make_scan(arc_on_plane(0.08, 0.025), sine(0.2e-3, 2.5e-3), {.rate_hz = 100.0});
  TipMotion bad = scan.motion;
  bad.p_world_tip_m[7].x() = NAN;
  EXPECT_THROW(find_base_path(bad, scan.tip_in_marker_m, {}), Error);
  bad = scan.motion;
  bad.t_ns[8] = bad.t_ns[7];
  EXPECT_THROW(find_base_path(bad, scan.tip_in_marker_m, {}), Error);
  bad = scan.motion;
  bad.force_N.assign(bad.size(), 0.0);
  EXPECT_THROW(find_base_path(bad, scan.tip_in_marker_m, {}), Error);
  EXPECT_THROW(find_base_path(TipMotion{}, scan.tip_in_marker_m, {}), Error);
}

}  // namespace
}  // namespace asperity
