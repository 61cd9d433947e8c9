#include "asperity/registration/register_path.h"

#include <limits>

#include <gmock/gmock.h>
#include <Eigen/Dense>

#include "asperity/base/error.h"
#include "asperity/registration/find_registration.h"
#include "asperity/registration/register_thesis.h"
#include "test_surfaces.h"

namespace asperity {
namespace {

using test::Body;
using test::bumpy_path;
using test::normal3;
using test::perturbed;
using test::pose_error_m;
using test::seen_from;

const Pose kWorldMesh{exp_rotation({0.3, -1.2, 0.8}), {0.2, -0.1, 0.4}};

const Body& bumpy_body() {
  static const Body body(test::bumpy_mesh());
  return body;
}

// The Cramér–Rao limit of the points' RMS motion: independent errors along the facets' normals.
double limit_m(const Body& body, const std::vector<Eigen::Vector3d>& p_m, double sigma_m) {
  Eigen::Vector3d mean_m = Eigen::Vector3d::Zero();
  for (const auto& p : p_m) mean_m += p / static_cast<double>(p_m.size());
  Eigen::Matrix<double, 6, 6> info = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Matrix<double, 6, 6> metric = info;
  for (const auto& p : p_m) {
    const auto& [a, b, c] = body.mesh.triangles[body.bvh.closest_point(p).triangle];
    const auto& v = body.mesh.vertices_m;
    const Eigen::Vector3d n = (v[b] - v[a]).cross(v[c] - v[a]).normalized();
    Eigen::Matrix<double, 6, 1> j;
    j << (p - mean_m).cross(n), n;
    info += j * j.transpose();
    Eigen::Matrix<double, 3, 6> motion;
    motion << -skew(p - mean_m), Eigen::Matrix3d::Identity();
    metric += motion.transpose() * motion / static_cast<double>(p_m.size());
  }
  return sigma_m * std::sqrt((info.inverse() * metric).trace());
}

TEST(RegisterPath, FindsAKnownMotionToRounding) {
  const Body& body = bumpy_body();
  const auto p_m = bumpy_path(body, 1500);
  Random random(1);
  for (int k = 0; k < 3; ++k) {
    const MeasuredPath path{seen_from(kWorldMesh, p_m, 0.0, random), {}, 0.0};
    const Pose guess = perturbed(kWorldMesh.inverse(), p_m, 5e-3, 5.0, random);
    const RegistrationResult got = register_path({&path, 1}, body.surface, guess, {});
    EXPECT_LT(pose_error_m(got.T_mesh_world, kWorldMesh, p_m), 1e-9);
    EXPECT_TRUE(got.converged);
    EXPECT_TRUE(got.trustworthy) << got.verdict;
    EXPECT_TRUE(got.undetermined.empty()) << got.verdict;
    EXPECT_EQ(got.points, p_m.size());
  }
}

TEST(RegisterPath, ReachesTheCramerRaoLimitUnderNoise) {
  const Body& body = bumpy_body();
  const auto p_m = bumpy_path(body, 1500);
  constexpr double kSigma_m = 0.15e-3;
  const double limit = limit_m(body, p_m, kSigma_m);
  Random random(2);
  double square = 0.0;
  constexpr int kRuns = 20;
  for (int k = 0; k < kRuns; ++k) {
    const MeasuredPath path{seen_from(kWorldMesh, p_m, kSigma_m, random), {}, 0.0};
    const Pose guess = perturbed(kWorldMesh.inverse(), p_m, 5e-3, 5.0, random);
    const RegistrationResult got = register_path({&path, 1}, body.surface, guess, {});
    square += std::pow(pose_error_m(got.T_mesh_world, kWorldMesh, p_m), 2) / kRuns;
    EXPECT_NEAR(got.rms_m, kSigma_m, 0.05 * kSigma_m);  // 2.6 standard errors
    EXPECT_TRUE(got.trustworthy) << got.verdict;
  }
  // The root mean square over 20 runs of some three effective degrees of freedom scatters by 9 %.
  EXPECT_LT(std::sqrt(square), 1.25 * limit);
  EXPECT_GT(std::sqrt(square), 0.75 * limit);
}

TEST(RegisterPath, TenPercentOutliersHardlyMatter) {
  const Body& body = bumpy_body();
  const auto p_m = bumpy_path(body, 1500);
  Random random(4);
  MeasuredPath path{seen_from(kWorldMesh, p_m, 0.15e-3, random), {}, 0.0};
  for (std::size_t i = 700; i < 850; ++i) path.p_world_m[i] += kWorldMesh.rotation * Eigen::Vector3d(4e-3, 3e-3, 6e-3);
  const Pose guess = perturbed(kWorldMesh.inverse(), p_m, 5e-3, 5.0, random);
  const RegistrationResult got = register_path({&path, 1}, body.surface, guess, {});
  EXPECT_LT(pose_error_m(got.T_mesh_world, kWorldMesh, p_m), 4.0 * limit_m(body, p_m, 0.15e-3));
  EXPECT_GT(got.outliers, 100U);
  EXPECT_LT(got.outliers, 200U);
}

TEST(RegisterPath, EverySamplingFindsIt) {
  const Body& body = bumpy_body();
  const auto p_m = bumpy_path(body, 1500);
  Random random(5);
  const MeasuredPath path{seen_from(kWorldMesh, p_m, 0.1e-3, random), {}, 0.1e-3};
  const Pose guess = perturbed(kWorldMesh.inverse(), p_m, 3e-3, 4.0, random);
  for (const auto sampling :
       {PathSampling::kUniform, PathSampling::kCurvature, PathSampling::kNormalSpace, PathSampling::kStability}) {
    for (const auto normals : {RegistrationNormals::kInterpolated, RegistrationNormals::kFacet}) {
      RegistrationConfig config;
      config.sampling = sampling;
      config.normals = normals;
      const RegistrationResult got = register_path({&path, 1}, body.surface, guess, config);
      EXPECT_LT(pose_error_m(got.T_mesh_world, kWorldMesh, p_m), 4.0 * limit_m(body, p_m, 0.1e-3));
    }
  }
}

TEST(RegisterPath, PathsAreJoinedRigidly) {
  const Body& body = bumpy_body();
  const auto p_m = bumpy_path(body, 1000);
  Random random(6);
  const auto world = seen_from(kWorldMesh, p_m, 0.0, random);
  const std::vector<MeasuredPath> paths{{{world.begin(), world.begin() + 300}, {}, 0.0},
                                        {{world.begin() + 700, world.end()}, {}, 0.0}};
  const RegistrationResult got =
      register_path(paths, body.surface, perturbed(kWorldMesh.inverse(), p_m, 3e-3, 3.0, random), {});
  EXPECT_LT(pose_error_m(got.T_mesh_world, kWorldMesh, p_m), 1e-9);
  EXPECT_EQ(got.points, 600U);
}

TEST(RegisterPath, TwiceTheSizeGivesTwiceTheAnswer) {
  const Body& body = bumpy_body();
  TriangleMesh twice = body.mesh;
  for (auto& v : twice.vertices_m) v *= 2.0;
  const Body large(std::move(twice));
  const auto p_m = bumpy_path(body, 800);
  Random random(7);
  MeasuredPath path{seen_from(kWorldMesh, p_m, 0.15e-3, random), {}, 0.0};
  Pose guess = perturbed(kWorldMesh.inverse(), p_m, 5e-3, 5.0, random);
  RegistrationConfig config;
  const RegistrationResult small = register_path({&path, 1}, body.surface, guess, config);
  for (auto& p : path.p_world_m) p *= 2.0;
  guess.translation_m *= 2.0;
  for (double* length : {&config.guess_sigma_m, &config.undetermined_m, &config.slide_m, &config.surface_error_m,
                         &config.starts.radius_m}) {
    *length *= 2.0;
  }
  const RegistrationResult got = register_path({&path, 1}, large.surface, guess, config);
  EXPECT_EQ(got.T_mesh_world.rotation.coeffs(), small.T_mesh_world.rotation.coeffs());
  EXPECT_EQ(got.T_mesh_world.translation_m, 2.0 * small.T_mesh_world.translation_m);
  EXPECT_EQ(got.rms_m, 2.0 * small.rms_m);
}

TEST(RegisterPath, RefusesWhatCannotBeRegistered) {
  const Body& body = bumpy_body();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  MeasuredPath path{{{0, 0, 0}, {0.01, 0, 0}, {nan, 0, 0}, {0, nan, 0}}, {}, 0.0};
  try {
    register_path({&path, 1}, body.surface, {}, {});
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("path 0, point 2"));
  }
  EXPECT_THROW(register_path({}, body.surface, {}, {}), Error);
  path.p_world_m.assign(5, Eigen::Vector3d::Ones());
  EXPECT_THROW(register_path({&path, 1}, body.surface, {}, {}), Error);
  path.p_world_m = bumpy_path(body, 50);
  path.outward_world.resize(3);
  EXPECT_THROW(register_path({&path, 1}, body.surface, {}, {}), Error);
  path.outward_world.clear();
  EXPECT_THROW(register_path({&path, 1}, RegistrationSurface{}, {}, {}), Error);
  EXPECT_THROW(register_path({&path, 1}, body.surface, {Eigen::Quaterniond(nan, 0, 0, 0), {}}, {}), Error);
  path.p_world_m[7].z() = nan;
  const RegistrationResult got = register_path({&path, 1}, body.surface, {}, {});
  ASSERT_EQ(got.problems.size(), 1U);
  EXPECT_EQ(got.problems[0].kind, "not_finite_points");
}

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
  const MeasuredPath path{out.world_m, {}, 0.0};
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
    EXPECT_THAT(got.result.undetermined[0].description, testing::StartsWith("slides along"));
    EXPECT_THAT(got.result.undetermined[1].description, testing::StartsWith("slides along"));
    EXPECT_THAT(got.result.undetermined[2].description, testing::HasSubstr("turns about the axis"));
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
    EXPECT_EQ(got.result.undetermined[0].description, "slides along (0.00, 0.00, 1.00)");
    EXPECT_THAT(got.result.undetermined[1].description, testing::HasSubstr("turns about the axis"));
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
      const Eigen::Vector3d at_centre = motion.shift - motion.turn.cross(motion.centre_mesh_m);
      EXPECT_LT(at_centre.norm(), 0.05 * motion.turn.norm() * kRadius_m);
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
  const MeasuredPath path{seen_from({}, p_m, 0.05e-3, random), {}, 0.0};
  RegistrationConfig config;
  config.starts.when = OtherStarts::kAlways;
  const RegistrationResult got =
      register_path({&path, 1}, body.surface, {Eigen::Quaterniond::Identity(), {5e-4, 0, 0}}, config);
  EXPECT_LT(std::abs((got.T_mesh_world * p_m[0] - p_m[0]).z()), 0.1e-3);
  ASSERT_TRUE(got.runner_up.has_value()) << got.verdict;
  EXPECT_NEAR(std::remainder(got.runner_up->distance_m, kPitch_m), 0.0, 0.1 * kPitch_m) << got.verdict;
  EXPECT_FALSE(got.trustworthy) << got.verdict;
  EXPECT_THAT(got.verdict, testing::HasSubstr("cannot tell"));
}

TEST(RegisterPath, LeavesAWrongBasinAndTrustsAUniquePlace) {
  const Body& body = bumpy_body();
  const auto p_m = bumpy_path(body, 1000);
  Random random(10);
  RegistrationConfig config;
  config.starts.when = OtherStarts::kAlways;
  for (int k = 0; k < 3; ++k) {
    const MeasuredPath path{seen_from(kWorldMesh, p_m, 0.1e-3, random), {}, 0.0};
    const Pose guess = perturbed(kWorldMesh.inverse(), p_m, 12e-3, 20.0, random);
    const RegistrationResult got = register_path({&path, 1}, body.surface, guess, config);
    EXPECT_LT(pose_error_m(got.T_mesh_world, kWorldMesh, p_m), 4.0 * limit_m(body, p_m, 0.1e-3)) << got.verdict;
    EXPECT_TRUE(got.trustworthy) << got.verdict;
  }
}

TEST(FindRegistration, NeedsNoGuess) {
  const Body& body = bumpy_body();
  const auto p_m = bumpy_path(body, 600);
  Random random(11);
  const MeasuredPath path{seen_from(kWorldMesh, p_m, 0.1e-3, random), {}, 0.0};
  const RegistrationResult got = find_registration({&path, 1}, body.surface, {});
  EXPECT_LT(pose_error_m(got.T_mesh_world, kWorldMesh, p_m), 4.0 * limit_m(body, p_m, 0.1e-3)) << got.verdict;
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
  MeasuredPath path{p_m, {}, 0.0};
  path.outward_world.assign(p_m.size(), Eigen::Vector3d::UnitZ());
  const RegistrationResult got =
      register_path({&path, 1}, body.surface, {Eigen::Quaterniond::Identity(), {0, 0, -1.2e-3}}, {});
  EXPECT_LT(pose_error_m(got.T_mesh_world, {}, p_m), 1e-6) << got.verdict;
}

TEST(RegisterThesis, StopsWhenTheErrorNoLongerChanges) {
  const Body& body = bumpy_body();
  const auto p_m = bumpy_path(body, 1500);
  Random random(12);
  const MeasuredPath path{seen_from(kWorldMesh, p_m, 0.1e-3, random), {}, 0.0};
  const Pose guess = perturbed(kWorldMesh.inverse(), p_m, 1e-3, 1.0, random);
  const RegistrationResult got = register_thesis({&path, 1}, body.bvh, guess, {});
  EXPECT_EQ(got.stopped_by, StopRule::kErrorChange);
  EXPECT_TRUE(got.converged);
  EXPECT_LT(got.mean_m, 0.1e-3);  // the seed's figure
  ThesisRegistrationConfig config;
  config.max_iterations = 2;
  const RegistrationResult stopped = register_thesis({&path, 1}, body.bvh, guess, config);
  EXPECT_EQ(stopped.stopped_by, StopRule::kIterationLimit);
  EXPECT_FALSE(stopped.converged);
  EXPECT_EQ(stopped.iterations, 2);
}

// Files have triangles that name a vertex twice; they have no edges, and no normal of their own.
TEST(PrepareSurface, TrianglesWithARepeatedVertexAreHarmless) {
  TriangleMesh mesh = test::bumpy_mesh();
  const Body plain(mesh);
  const std::size_t whole = mesh.triangles.size();
  for (std::uint32_t v = 0; v < 50; ++v) mesh.triangles.push_back({v, v, v + 1});
  const Body body(std::move(mesh));
  for (std::size_t f = 0; f < whole; ++f) {
    EXPECT_EQ(body.surface.facets[f].border, plain.surface.facets[f].border);
    EXPECT_EQ(body.surface.facets[f].corner_normal, plain.surface.facets[f].corner_normal);
  }
  for (std::size_t f = whole; f < body.surface.facets.size(); ++f) EXPECT_EQ(body.surface.facets[f].border, 0u);
}

}  // namespace
}  // namespace asperity
