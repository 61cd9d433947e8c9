#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "asperity/profile/find_base_path.h"
#include "synthetic_path.h"

namespace asperity {
namespace {

using namespace synthetic;

constexpr double kRow_m = 0.02, kTurn_m = 1.25e-3, kSpeed_mps = 0.025, kRows = 6;
constexpr double kPeriod_m = kRow_m + std::numbers::pi * kTurn_m;

// Rows that half circles join, as a map of the place along them: (u, v), centred.
Eigen::Vector2d raster(double s_m) {
  const int row = static_cast<int>(s_m / kPeriod_m);
  const double in_row_m = s_m - row * kPeriod_m, angle = std::max(0.0, in_row_m - kRow_m) / kTurn_m;
  const double reach_m = std::min(in_row_m, kRow_m) + kTurn_m * std::sin(angle);
  return {(row % 2 == 0 ? reach_m : kRow_m - reach_m) - 0.5 * kRow_m,
          2.0 * kTurn_m * (row - 0.5 * kRows) + kTurn_m * (1.0 - std::cos(angle))};
}

// The raster over a sphere (by its two angles), outside or inside. `length_m` is summed over steps of 0.2 ms.
Scan over_sphere(double radius_m, bool outside, const std::function<double(double)>& height, Options options) {
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.7, Eigen::Vector3d(0.3, -0.2, 1.0).normalized()));
  const auto radial = [=](double t) {
    const Eigen::Vector2d u = raster(kSpeed_mps * t) / radius_m;
    return Eigen::Vector3d(
        turn * Eigen::Vector3d(std::sin(u.x()), std::cos(u.x()) * std::sin(u.y()), std::cos(u.x()) * std::cos(u.y())));
  };
  double s_m = 0.0, before_s = 0.0;
  const auto base = [=](double t) mutable {
    for (; before_s + 2e-4 <= t; before_s += 2e-4)
      s_m += radius_m * (radial(before_s + 2e-4) - radial(before_s)).norm();
    const Eigen::Vector3d r = radial(t);
    return Point{radius_m * r, outside ? r : Eigen::Vector3d(-r), s_m};
  };
  options.duration_s = (kRows * kPeriod_m - 0.01) / kSpeed_mps;
  Scan scan = make_scan(base, height, options);
  const double sigma_m = std::max(options.slow_sigma_m, 1e-6);
  scan.motion.cov_world_tip_m2.assign(scan.motion.size(), sigma_m * sigma_m * Eigen::Matrix3d::Identity());
  return scan;
}

// Taken for a plane, a sphere's sag of 0.6 mm a row is a wave that each reversal breaks.
TEST(BasePath, RowsOverASphereAreDoublyCurved) {
  constexpr double kRadius_m = 0.08;
  for (const bool outside : {true, false}) {
    const Scan scan = over_sphere(kRadius_m, outside, sine(10e-6, 1.1e-3), {.slow_sigma_m = 0.03e-3});
    const BasePathResult result = find_base_path(scan.motion, scan.tip_in_marker_m, {});
    ASSERT_EQ(result.shape, PathShape::kDoublyCurved) << outside;
    const double sign = outside ? 1.0 : -1.0;
    // 0.03 mm that last are 3 /m over 5 mm to either side, and 0.6 over 10 mm.
    EXPECT_NEAR(result.curvatures_per_m.x(), sign / kRadius_m, 3.0) << outside;
    EXPECT_NEAR(result.curvatures_per_m.y(), sign / kRadius_m, 3.0) << outside;
    double square = 0.0, worst = 0.0;
    for (std::size_t i = 0; i < scan.motion.size(); ++i) {
      const double height_m = result.path.n_world[i].dot(scan.motion.p_world_tip_m[i] - result.path.p_world_m[i]);
      square += std::pow(height_m - scan.height_m[i], 2) / static_cast<double>(scan.motion.size());
      worst = std::max(worst, (result.path.n_world[i] - scan.normal[i]).norm());
    }
    EXPECT_LT(std::sqrt(square), 0.05e-3) << outside;  // the errors that last, of which the fit takes a part
    EXPECT_LT(worst, 0.03) << outside;                 // rad; 0.125 at the rows' ends
    EXPECT_NEAR(result.length_m / scan.s_m.back(), 1.0, 0.004) << outside;  // 0.3 mm of 143: errors of the ends, bends
  }
}

TEST(BasePath, ExactSpheresAreExact) {
  const Scan scan = over_sphere(0.05, true, [](double) { return 0.0; }, {});
  BasePathConfig config;
  config.shape = PathShape::kDoublyCurved;
  const BasePathResult result = find_base_path(scan.motion, scan.tip_in_marker_m, config);
  EXPECT_NEAR(result.curvatures_per_m.x(), 20.0, 1e-3);
  EXPECT_NEAR(result.curvatures_per_m.y(), 20.0, 1e-3);
  EXPECT_LT(result.base_rms_m, 1e-8);
}

// A radius of a kilometre is a plane.
TEST(BasePath, RowsOverAPlaneLieOnAPlane) {
  int flat = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Scan scan = over_sphere(1000.0, true, sine(10e-6, 1.1e-3), {.slow_sigma_m = 0.03e-3, .seed = seed});
    flat += find_base_path(scan.motion, scan.tip_in_marker_m, {}).shape == PathShape::kPlane ? 1 : 0;
  }
  EXPECT_GE(flat, 14);
}

// To and fro over one line with a force that rises by 1.6 N, on a contact of 0.5 mm/N: the path spans the plane of the
// stroke and the depth, which the probe lies in.
TEST(BasePath, StrokesOverOneLineThatSinkDeeperHaveTheProbesNormal) {
  const auto line =
      on_plane([](double t) { return Eigen::Vector2d(t < 1.6 ? kSpeed_mps * t : kSpeed_mps * (3.2 - t), 0.0); },
               [](double t) { return kSpeed_mps * t; });
  const auto base = [&](double t) {
    Point p = line(t);
    p.p_m -= 0.25e-3 * t * p.normal;
    return p;
  };
  Scan scan = make_scan(base, sine(10e-6, 1.1e-3), {.duration_s = 3.2, .slow_sigma_m = 0.03e-3});
  for (std::size_t i = 0; i < scan.motion.size(); ++i) scan.motion.force_N[i] = 0.4 + 0.5e-9 * scan.motion.t_ns[i];
  const BasePathResult result = find_base_path(scan.motion, scan.tip_in_marker_m, {});
  EXPECT_LT(result.probe_tilt_deg, 25.0);
  double worst = 1.0;
  for (std::size_t i = 0; i < scan.normal.size(); ++i)
    worst = std::min(worst, result.path.n_world[i].dot(scan.normal[i]));
  EXPECT_GT(worst, std::cos(20.0 * std::numbers::pi / 180.0));  // as a hand holds the probe
}

// Two strokes the same way in a hollow cylinder, the tip lifted between: a mean over the lift is a point inside it, and
// the cylinder was taken for a plane across its axis, which the probe lies in.
TEST(BasePath, StrokesInAHollowCylinderWithALiftBetweenAreRound) {
  constexpr double kRadius_m = 0.054, kStroke_s = 2.0, kLift_s = 0.6;
  const auto around = across_cylinder(kRadius_m, kSpeed_mps, false);
  const auto base = [&](double t) {
    if (t <= kStroke_s) return around(t);
    const double back = std::min(1.0, (t - kStroke_s) / kLift_s);
    Point p = around(t <= kStroke_s + kLift_s ? kStroke_s * (1.0 - back) : t - kStroke_s - kLift_s);
    if (t < kStroke_s + kLift_s) p.p_m += 5e-3 * std::sin(std::numbers::pi * back) * p.normal;
    p.s_m = kSpeed_mps * std::min(t, std::max(kStroke_s, t - kLift_s));
    return p;
  };
  Scan scan = make_scan(base, sine(20e-6, 1.3e-3), {.duration_s = 2.0 * kStroke_s + kLift_s, .slow_sigma_m = 0.03e-3});
  for (std::size_t i = 0; i < scan.motion.size(); ++i) {
    const double t = 1e-9 * static_cast<double>(scan.motion.t_ns[i]);
    if (t > kStroke_s && t < kStroke_s + kLift_s) scan.motion.force_N[i] = 0.0;
  }
  const BasePathResult result = find_base_path(scan.motion, scan.tip_in_marker_m, {});
  EXPECT_EQ(result.shape, PathShape::kCircle);
  EXPECT_FALSE(result.outside);
  EXPECT_NEAR(result.radius_m, kRadius_m, std::max(4.0 * result.radius_stderr_m, 1e-3));
  EXPECT_LT(result.probe_tilt_deg, 30.0);
}

}  // namespace
}  // namespace asperity
