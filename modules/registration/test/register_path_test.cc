#include "asperity/registration/register_path.h"

#include <limits>

#include <gmock/gmock.h>
#include <Eigen/Dense>

#include "asperity/base/error.h"
#include "test_surfaces.h"

namespace asperity {
namespace {

using test::Body;
using test::bumpy_body;
using test::bumpy_path;
using test::kWorldMesh;
using test::limit_m;
using test::normal3;
using test::perturbed;
using test::pose_error_m;
using test::seen_from;

TEST(RegisterPath, FindsAKnownMotionToRounding) {
  const Body& body = bumpy_body();
  const auto p_m = bumpy_path(body, 1500);
  Random random(1);
  for (int k = 0; k < 3; ++k) {
    const MeasuredPath path = test::path_of(seen_from(kWorldMesh, p_m, 0.0, random), 0.0);
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
    const MeasuredPath path = test::path_of(seen_from(kWorldMesh, p_m, kSigma_m, random), 0.0);
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
  MeasuredPath path = test::path_of(seen_from(kWorldMesh, p_m, 0.15e-3, random), 0.0);
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
  const MeasuredPath path = test::path_of(seen_from(kWorldMesh, p_m, 0.1e-3, random), 0.1e-3);
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
  const std::vector<MeasuredPath> paths{test::path_of({world.begin(), world.begin() + 300}, 0.0),
                                        test::path_of({world.begin() + 700, world.end()}, 0.0)};
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
  MeasuredPath path = test::path_of(seen_from(kWorldMesh, p_m, 0.15e-3, random), 0.0);
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
  MeasuredPath path = test::path_of({{0, 0, 0}, {0.01, 0, 0}, {nan, 0, 0}, {0, nan, 0}}, 0.0);
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

}  // namespace
}  // namespace asperity
