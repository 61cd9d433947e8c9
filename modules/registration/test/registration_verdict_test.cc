#include "asperity/registration/register_path.h"

#include <functional>
#include <numbers>

#include <gmock/gmock.h>
#include <Eigen/Dense>

#include "test_surfaces.h"

namespace asperity {
namespace {

using test::Body;
using test::bumpy_body;
using test::bumpy_path;
using test::kWorldMesh;
using test::limit_m;
using test::perturbed;
using test::pose_error_m;
using test::seen_from;

// A path over a smooth body, registered from nearby; what it says is undetermined, and how far it strayed along that.
struct Smooth {
  RegistrationResult result;
  Pose guess;
  std::vector<Eigen::Vector3d> world_m;
};

Smooth register_smooth(const Body& body, const std::vector<Eigen::Vector3d>& path_m, double sigma_m, const Pose& off) {
  Random random(8);
  Smooth out;
  out.world_m = seen_from({}, test::laid_on(body, path_m), sigma_m, random);
  out.guess = off;
  const MeasuredPath path = test::path_of(out.world_m, 0.0);
  out.result = register_path({&path, 1}, body.surface, off, {});
  return out;
}

// The path where the guess puts it.
std::vector<Eigen::Vector3d> seen_by(const Smooth& smooth) {
  std::vector<Eigen::Vector3d> out;
  for (const auto& p : smooth.world_m) out.push_back(smooth.guess * p);
  return out;
}

std::vector<Eigen::Vector3d> wavy(double length_m, double width_m,
                                  const std::function<Eigen::Vector3d(double, double)>& at) {
  std::vector<Eigen::Vector3d> out;
  for (int i = 0; i < 1000; ++i) {
    const double t = i / 999.0;
    out.push_back(at(length_m * (t - 0.5), width_m * std::sin(20.0 * t)));
  }
  return out;
}

TEST(RegisterPath, APlaneLeavesTwoSlidesAndATurn) {
  const Body body(
      test::grid(100, 100, [](double u, double v) { return Eigen::Vector3d(0.2 * u - 0.1, 0.2 * v - 0.1, 0); }));
  const auto path = wavy(0.06, 0.01, [](double a, double b) { return Eigen::Vector3d(a, b, 0); });
  for (const double sigma_m : {0.0, 0.15e-3}) {
    const Smooth got = register_smooth(body, path, sigma_m, {exp_rotation({0.03, -0.02, 0.05}), {2e-3, 3e-3, 2e-3}});
    ASSERT_EQ(got.result.undetermined.size(), 3U) << got.result.verdict;
    EXPECT_THAT(got.result.undetermined[0].description, testing::StartsWith("sliding along"));
    EXPECT_THAT(got.result.undetermined[1].description, testing::StartsWith("sliding along"));
    EXPECT_THAT(got.result.undetermined[2].description, testing::HasSubstr("rotation about the axis"));
    EXPECT_THAT(got.result.undetermined[2].description, testing::HasSubstr("along (0.00, 0.00, 1.00)"));
    // The mean's place in the plane stays the guess's, and so does the turn in it.
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const auto& p : got.world_m) mean += p / 1000.0;
    EXPECT_LT((got.result.T_mesh_world * mean - got.guess * mean).head<2>().norm(), 1e-5);
    const Eigen::Vector3d turn = log_rotation(got.result.T_mesh_world.rotation * got.guess.rotation.conjugate());
    EXPECT_LT(std::abs(turn.z()), 2e-3);
    EXPECT_LT(std::abs((got.result.T_mesh_world * mean).z()), 5e-5);
  }
}

TEST(RegisterPath, ACylinderLeavesASlideAndATurn) {
  constexpr double kRadius_m = 0.02;
  const Body body(test::grid(200, 64, [](double u, double v) {
    const double phi = 2.0 * std::numbers::pi * v;
    return Eigen::Vector3d(kRadius_m * std::cos(-phi), kRadius_m * std::sin(-phi), 0.2 * u - 0.1);
  }));
  const auto path = wavy(0.06, 1.0, [](double a, double b) {
    return Eigen::Vector3d(kRadius_m * std::cos(b), kRadius_m * std::sin(b), a);
  });
  for (const double sigma_m : {0.0, 0.15e-3}) {
    const Smooth got = register_smooth(body, path, sigma_m, {exp_rotation({0.03, -0.02, 0.1}), {1e-3, 1e-3, 3e-3}});
    ASSERT_EQ(got.result.undetermined.size(), 2U) << got.result.verdict;
    EXPECT_EQ(got.result.undetermined[0].description, "sliding along (0.00, 0.00, 1.00)");
    EXPECT_THAT(got.result.undetermined[1].description, testing::HasSubstr("rotation about the axis"));
    EXPECT_THAT(got.result.undetermined[1].description, testing::HasSubstr("along (0.00, 0.00, 1.00)"));
    // Of all poses that fit, slid and turned, this one is nearest to the guess.
    const auto strayed_m = [&](double slide_m, double turn_rad) {
      const Pose moved = Pose{exp_rotation({0, 0, turn_rad}), {0, 0, slide_m}} * got.result.T_mesh_world;
      return pose_error_m(moved, got.guess.inverse(), seen_by(got));
    };
    for (const double way : {-1.0, 1.0}) {
      EXPECT_LT(strayed_m(0, 0), strayed_m(way * 0.4e-3, 0));
      EXPECT_LT(strayed_m(0, 0), strayed_m(0, way * 0.02));
    }
  }
}

TEST(RegisterPath, ASphereLeavesThreeTurns) {
  constexpr double kRadius_m = 0.03;
  const Body body(
      test::grid(60, 120, [&](double u, double v) { return Eigen::Vector3d(kRadius_m * test::spherical(u, v)); }));
  const auto path = wavy(1.5, 0.5, [&](double a, double b) {
    return Eigen::Vector3d(kRadius_m *
                           Eigen::Vector3d(std::cos(a) * std::cos(b), std::sin(a) * std::cos(b), std::sin(b)));
  });
  for (const double sigma_m : {0.0}) {
    const Smooth got = register_smooth(body, path, sigma_m, {exp_rotation({0.05, -0.04, 0.1}), {1e-3, 1e-3, 1e-3}});
    ASSERT_EQ(got.result.undetermined.size(), 3U) << got.result.verdict;
    for (const auto& motion : got.result.undetermined) {
      // Each turns about the centre: the velocity there, shift + turn x (0 - mean), vanishes.
      const Eigen::Vector3d at_centre = motion.shift_m - motion.rotation_rad.cross(motion.centre_mesh_m);
      EXPECT_LT(at_centre.norm(), 0.05 * motion.rotation_rad.norm() * kRadius_m);
    }
    EXPECT_LT((got.result.T_mesh_world * Eigen::Vector3d::Zero()).norm(), 2e-4);
  }
}

TEST(RegisterPath, SaysWhenAnotherPlaceFitsAsWell) {
  // Ridges of 8 mm pitch: the path fits one ridge on as well.
  constexpr double kPitch_m = 8e-3;
  const auto ridge = [](double x_m) { return 1e-3 * std::sin(2.0 * std::numbers::pi * x_m / kPitch_m); };
  const Body body(test::grid(400, 40, [&](double u, double v) {
    const double x_m = 0.2 * u - 0.1;
    return Eigen::Vector3d(x_m, 0.2 * v - 0.1, ridge(x_m));
  }));
  Random random(9);
  const auto p_m =
      test::laid_on(body, wavy(0.05, 0.01, [&](double a, double b) { return Eigen::Vector3d(a, b, ridge(a)); }));
  const MeasuredPath path = test::path_of(seen_from({}, p_m, 0.05e-3, random), 0.0);
  RegistrationConfig config;
  config.starts.when = OtherStarts::kAlways;
  const RegistrationResult got =
      register_path({&path, 1}, body.surface, {Eigen::Quaterniond::Identity(), {5e-4, 0, 0}}, config);
  EXPECT_LT(std::abs((got.T_mesh_world * p_m[0] - p_m[0]).z()), 0.1e-3);
  ASSERT_TRUE(got.runner_up.has_value()) << got.verdict;
  EXPECT_NEAR(std::remainder(got.runner_up->distance_m, kPitch_m), 0.0, 0.1 * kPitch_m) << got.verdict;
  EXPECT_FALSE(got.trustworthy) << got.verdict;
  EXPECT_THAT(got.verdict, testing::HasSubstr("does not determine which is correct"));
}

TEST(RegisterPath, LeavesAWrongBasinAndTrustsAUniquePlace) {
  const Body& body = bumpy_body();
  const auto p_m = bumpy_path(body, 1000);
  Random random(10);
  RegistrationConfig config;
  config.starts.when = OtherStarts::kAlways;
  for (int k = 0; k < 3; ++k) {
    const MeasuredPath path = test::path_of(seen_from(kWorldMesh, p_m, 0.1e-3, random), 0.0);
    const Pose guess = perturbed(kWorldMesh.inverse(), p_m, 12e-3, 20.0, random);
    const RegistrationResult got = register_path({&path, 1}, body.surface, guess, config);
    EXPECT_LT(pose_error_m(got.T_mesh_world, kWorldMesh, p_m), 4.0 * limit_m(body, p_m, 0.1e-3)) << got.verdict;
    EXPECT_TRUE(got.trustworthy) << got.verdict;
  }
}

TEST(RegisterPath, TheProbesSideTellsTheFrontOfAPlateFromItsBack) {
  // A plate 1 mm thick, its front wavy; the guess puts the path nearer to the back.
  const auto front = [](double x, double y) { return 0.3e-3 * std::sin(300.0 * x) * std::cos(250.0 * y + 100.0 * x); };
  TriangleMesh plate = test::grid(150, 150, [&](double u, double v) {
    const double x = 0.1 * u - 0.05;
    const double y = 0.1 * v - 0.05;
    return Eigen::Vector3d(x, y, front(x, y));
  });
  const TriangleMesh back =
      test::grid(150, 150, [](double u, double v) { return Eigen::Vector3d(0.1 * v - 0.05, 0.1 * u - 0.05, -1.5e-3); });
  const auto base = static_cast<std::uint32_t>(plate.vertices_m.size());
  plate.vertices_m.insert(plate.vertices_m.end(), back.vertices_m.begin(), back.vertices_m.end());
  for (const auto& [a, b, c] : back.triangles) plate.triangles.push_back({a + base, b + base, c + base});
  const Body body(std::move(plate));
  const auto p_m =
      test::laid_on(body, wavy(0.06, 0.02, [&](double a, double b) { return Eigen::Vector3d(a, b, front(a, b)); }));
  MeasuredPath path = test::path_of(p_m, 0.0);
  path.outward_world.assign(p_m.size(), Eigen::Vector3d::UnitZ());
  const RegistrationResult got =
      register_path({&path, 1}, body.surface, {Eigen::Quaterniond::Identity(), {0, 0, -1.2e-3}}, {});
  EXPECT_LT(pose_error_m(got.T_mesh_world, {}, p_m), 1e-6) << got.verdict;
}

}  // namespace
}  // namespace asperity
