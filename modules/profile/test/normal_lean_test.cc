#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>

#include <gtest/gtest.h>

#include "asperity/base/random.h"
#include "asperity/profile/find_base_path.h"
#include "synthetic_path.h"

// Strokes whose normals lean against the plane of their path by a known angle, with a known tremor: of the true object
// are the points and normals, in closed form.
namespace asperity {
namespace {

using namespace synthetic;

constexpr double kDegree_rad = std::numbers::pi / 180.0;
constexpr double kSpeed_mps = 0.03, kSeconds = 3.0;
constexpr double kTremor_m = 40e-6;

// A hand's tremor, incommensurate waves about 9 Hz with an RMS of kTremor_m.
double tremor_m(double t_s) {
  double sum = 0.0;
  const double at_Hz[] = {7.9, 8.7, 9.4, 10.3, 11.1};
  for (int k = 0; k < 5; ++k) sum += std::sin(2.0 * std::numbers::pi * at_Hz[k] * t_s + 1.3 * k * k);
  return kTremor_m * sum / std::sqrt(2.5);
}

// On a torus: the circle of latitude `lean_rad` on the tube. Its curvature is 1/R, R its radius; its normals lean by
// `lean_rad` from its plane towards the torus' axis, so the geodesic curvature is sin(lean)/R. The tremor goes round
// the tube, of radius `tube_m`.
std::function<Point(double)> along_torus(double radius_m, double tube_m, double lean_rad) {
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.9, Eigen::Vector3d(0.3, -0.2, 1.0).normalized()));
  return [=](double t) {
    const double around = kSpeed_mps * t / radius_m - 0.5 * kSpeed_mps * kSeconds / radius_m;
    const double v = lean_rad + tremor_m(t) / tube_m;
    const double middle_m = radius_m - tube_m * std::cos(lean_rad);
    const Eigen::Vector3d out(std::cos(around), std::sin(around), 0.0);
    const Eigen::Vector3d n = std::cos(v) * out + std::sin(v) * Eigen::Vector3d::UnitZ();
    return Point{turn * Eigen::Vector3d(middle_m * out + tube_m * n), turn * n, kSpeed_mps * t};
  };
}

// Across a cylinder, the tremor along its axis.
std::function<Point(double)> over_cylinder(double radius_m) {
  const auto base = across_cylinder(radius_m, kSpeed_mps, true);
  return [=](double t) {
    Point out = base(t);
    const Eigen::Vector3d axis = base(0.0).normal.cross(base(0.5).normal).normalized();
    out.p_m += tremor_m(t) * axis;
    return out;
  };
}

// A straight stroke on a plane, the tremor across it.
std::function<Point(double)> on_flat() {
  return on_plane([](double t) { return Eigen::Vector2d(kSpeed_mps * t, tremor_m(t)); },
                  [](double t) { return kSpeed_mps * t; });
}

Scan scan_of(const std::function<Point(double)>& base, const std::function<double(double)>& height,
             const Eigen::Vector3d& probe_lean = Eigen::Vector3d::Zero()) {
  return make_scan(base, height,
                   {.rate_hz = 1000.0,
                    .duration_s = kSeconds,
                    .slow_sigma_m = 0.03e-3,
                    .fine_sigma_m = 0.3e-6,
                    .probe_lean = probe_lean});
}

// RMS over the path of the angle about the direction of travel between normals found and true.
double lean_deg(const BasePathResult& base, const Scan& scan) {
  double square = 0.0;
  const std::size_t n = scan.normal.size();
  for (std::size_t i = 100; i + 100 < n; ++i) {
    const Eigen::Vector3d t = (scan.motion.p_world_tip_m[i + 90] - scan.motion.p_world_tip_m[i - 90]).normalized();
    square += std::pow(base.path.n_world[i].cross(scan.normal[i]).dot(t), 2) / static_cast<double>(n - 200);
  }
  return std::sqrt(square) / kDegree_rad;
}

double no_height(double /*s_m*/) { return 0.0; }

TEST(NormalLean, ATremorOverASmoothTorusShowsTheLeanOfAGeodesicCurvature) {
  // 1/50 mm and a lean of 12°: a geodesic curvature of 4.2 /m, which the circle of the path has no sign of.
  for (const double lean : {-12.0, 0.0, 12.0}) {
    const Scan scan = scan_of(along_torus(0.05, 0.02, lean * kDegree_rad), no_height);
    BasePathConfig config;
    config.shape = PathShape::kCircle;
    const BasePathResult base = find_base_path(scan.motion, scan.tip_in_marker_m, config);
    EXPECT_LT(lean_deg(base, scan), 3.0) << lean;
    EXPECT_LT(base.normal_sigma_deg, 5.0);
    EXPECT_LT(lean_deg(base, scan), 2.5 * base.normal_sigma_deg);
    EXPECT_NEAR(base.radius_m, 0.05, 2e-3);
  }
}

TEST(NormalLean, WithoutTheMotionTheGeodesicCurvatureIsInTheSigma) {
  const Scan scan = scan_of(along_torus(0.05, 0.02, 12.0 * kDegree_rad), no_height, Eigen::Vector3d(0.0, 0.0, 0.0));
  BasePathConfig config;
  config.shape = PathShape::kCircle;
  config.texture_axis_sigma_deg = 0.0;
  const BasePathResult base = find_base_path(scan.motion, scan.tip_in_marker_m, config);
  // 3 /m over 20 /m are 8.6°; the probe's axis, within 20°, knows little more.
  EXPECT_GT(base.normal_sigma_deg, 5.0);
  EXPECT_LT(lean_deg(base, scan), 2.0 * base.normal_sigma_deg);
}

TEST(NormalLean, ATremorAcrossASmoothCylinderDoesNotTurnIt) {
  // Its motion above 15 Hz, where there is any, is along the axis: it is no normal.
  const Scan scan = scan_of(over_cylinder(0.06), no_height, Eigen::Vector3d(0.15, -0.1, 0.1));
  BasePathConfig config;
  config.shape = PathShape::kCircle;
  const BasePathResult base = find_base_path(scan.motion, scan.tip_in_marker_m, config);
  EXPECT_LT(lean_deg(base, scan), 3.0);
  EXPECT_NEAR(base.radius_m, 0.06, 1.5e-3);
}

TEST(NormalLean, OfAStraightStrokeBothTremorAndTextureShowIt) {
  for (const double height_m : {0.0, 60e-6}) {
    const Scan scan = scan_of(on_flat(), sine(height_m, 1.1e-3), Eigen::Vector3d(0.1, 0.3, 0.0));
    BasePathConfig config;
    const BasePathResult with = find_base_path(scan.motion, scan.tip_in_marker_m, config);
    config.texture_axis_sigma_deg = 0.0;
    const BasePathResult without = find_base_path(scan.motion, scan.tip_in_marker_m, config);
    EXPECT_GT(lean_deg(without, scan), 8.0);
    EXPECT_LT(lean_deg(with, scan), 2.5) << height_m;
    EXPECT_LT(with.normal_sigma_deg, without.normal_sigma_deg);
  }
}

// A gyroscope on a lever of 120 mm: its error θ, the integral of white noise, moves the tip by θ × l, across the
// probe's axis only. The white noise of the place that all of these scans have is an acceleration of 2.3e-7 m²/s³ at 30
// Hz.
constexpr double kAcceleration_m2ps3 = 2.3e-7;

Scan with_gyroscope_noise(Scan scan, double noise_rad2ps3, std::uint64_t seed) {
  constexpr double kRate_Hz = 1000.0;  // that of scan_of()
  Random random(seed, 11);
  const double step_rad = std::sqrt(0.5 * noise_rad2ps3 * kRate_Hz) / kRate_Hz;
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < scan.normal.size(); ++i) {
    const Eigen::Vector3d lever_m = scan.motion.q_world_marker[i] * scan.tip_in_marker_m;
    scan.motion.p_world_tip_m[i] += turn.cross(lever_m);
    scan.motion.q_world_marker[i] = exp_rotation(turn) * scan.motion.q_world_marker[i];
    turn += step_rad * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
  }
  scan.motion.noise.accel_m2ps3 = kAcceleration_m2ps3;
  scan.motion.noise.tip_from_sensor_m = scan.tip_in_marker_m;
  return scan;
}

TEST(NormalLean, NoiseOfTheGyroscopeDoesNotTurnTheNormalsToTheProbe) {
  // Above 15 Hz only noise moves the tip, across the probe's axis, which leans by 0.3: unless that noise is known, it
  // is a tremor about normals that lean as the probe does, and outvotes the hand's own at 9 Hz.
  double with_square = 0.0, ratio_square = 0.0, without_square = 0.0;
  constexpr int kSeeds = 6;
  constexpr double kPoor_rad2ps3 = 1.2e-7;  // 20 mdps/√Hz
  for (int seed = 1; seed <= kSeeds; ++seed) {
    Scan scan = with_gyroscope_noise(scan_of(on_flat(), no_height, Eigen::Vector3d(0.1, 0.3, 0.0)), kPoor_rad2ps3,
                                     static_cast<std::uint64_t>(seed));
    const BasePathResult with = find_base_path(scan.motion, scan.tip_in_marker_m, {});
    scan.motion.noise = {};
    const BasePathResult without = find_base_path(scan.motion, scan.tip_in_marker_m, {});
    with_square += std::pow(lean_deg(with, scan), 2) / kSeeds;
    ratio_square += std::pow(lean_deg(with, scan) / with.normal_sigma_deg, 2) / kSeeds;
    without_square += std::pow(lean_deg(without, scan) / without.normal_sigma_deg, 2) / kSeeds;
  }
  EXPECT_LT(std::sqrt(with_square), 3.0);
  EXPECT_LT(std::sqrt(ratio_square), 1.5);  // six draws of χ² about 1: 1.5 is at 0.995
  EXPECT_GT(std::sqrt(without_square), 2.0);
}

TEST(NormalLean, NoiseAloneSaysNothingOfTheLean) {
  // No tremor and no texture: what is known of the lean is what path and probe say.
  const auto still =
      on_plane([](double t) { return Eigen::Vector2d(kSpeed_mps * t, 0.0); }, [](double t) { return kSpeed_mps * t; });
  constexpr int kSeeds = 6;
  double ratio_square = 0.0, sigma_deg = 0.0, unused_deg = 0.0;
  constexpr double kGood_rad2ps3 = 4e-9;  // 3.6 mdps/√Hz: at 30 Hz nine times the accelerometer's noise
  for (int seed = 1; seed <= kSeeds; ++seed) {
    const Scan scan = with_gyroscope_noise(scan_of(still, no_height, Eigen::Vector3d(0.1, 0.3, 0.0)), kGood_rad2ps3,
                                           static_cast<std::uint64_t>(seed));
    const BasePathResult with = find_base_path(scan.motion, scan.tip_in_marker_m, {});
    BasePathConfig config;
    config.texture_axis_sigma_deg = 0.0;
    const BasePathResult unused = find_base_path(scan.motion, scan.tip_in_marker_m, config);
    ratio_square += std::pow(lean_deg(with, scan) / with.normal_sigma_deg, 2) / kSeeds;
    sigma_deg += with.normal_sigma_deg / kSeeds;
    unused_deg += unused.normal_sigma_deg / kSeeds;
  }
  EXPECT_LT(std::sqrt(ratio_square), 1.5);  // as above
  EXPECT_GT(sigma_deg, 0.5 * unused_deg);   // a single draw of noise may look like something
}

TEST(NormalLean, ThreeAxesOfForceShowIt) {
  Scan scan = make_scan(along_torus(0.05, 0.02, 12.0 * kDegree_rad), no_height,
                        {.rate_hz = 1000.0, .duration_s = kSeconds, .slow_sigma_m = 0.03e-3});
  BasePathConfig config;
  config.shape = PathShape::kCircle;
  config.texture_axis_sigma_deg = 0.0;
  for (std::size_t i = 0; i < scan.normal.size(); ++i) {
    const std::size_t a = i == 0 ? 0 : i - 1, b = std::min(i + 1, scan.normal.size() - 1);
    const Eigen::Vector3d step = scan.motion.p_world_tip_m[b] - scan.motion.p_world_tip_m[a];
    const Eigen::Vector3d t = (step - step.dot(scan.normal[i]) * scan.normal[i]).normalized();
    scan.motion.force_world_N.push_back(scan.normal[i] - 0.3 * t);
  }
  const BasePathResult base = find_base_path(scan.motion, scan.tip_in_marker_m, config);
  EXPECT_LT(std::abs(base.lean_rad), 20.0 * kDegree_rad);
  EXPECT_LT(lean_deg(base, scan), 4.0);
}

}  // namespace
}  // namespace asperity
