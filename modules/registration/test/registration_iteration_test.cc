#include "asperity/registration/registration_iteration.h"

#include <cmath>
#include <cstring>
#include <vector>

#include <gtest/gtest.h>

#include "asperity/base/random.h"
#include "asperity/geometry/mesh_surface.h"
#include "asperity/registration/find_registration.h"
#include "asperity/registration/refine_registration.h"
#include "asperity/registration/register_path.h"
#include "test_surfaces.h"

namespace asperity {
namespace {

using Eigen::Vector3d;

struct Case {
  MeasuredPath path;
  Pose guess;
};

// 600 points with 20 µm of noise, and a guess 5 mm and 5 degrees off.
Case make_case() {
  Random random(11);
  const std::vector<Vector3d> p_mesh_m = test::bumpy_path(test::bumpy_body(), 600);
  Case out;
  out.path.p_world_m = test::seen_from(test::kWorldMesh, p_mesh_m, 20e-6, random);
  out.path.slow_covariance_world_m2 = 1e-8 * Eigen::Matrix3d::Identity();
  out.guess = test::perturbed(test::kWorldMesh.inverse(), p_mesh_m, 5e-3, 5.0, random);
  return out;
}

bool same_bits(const Pose& a, const Pose& b) {
  return std::memcmp(a.rotation.coeffs().data(), b.rotation.coeffs().data(), 4 * sizeof(double)) == 0 &&
         std::memcmp(a.translation_m.data(), b.translation_m.data(), 3 * sizeof(double)) == 0;
}

RegistrationObserver keeping(std::vector<RegistrationIteration>& iterations) {
  RegistrationObserver out;
  out.iterated = [&iterations](const RegistrationIteration& iteration) { iterations.push_back(iteration); };
  return out;
}

TEST(RegistrationIteration, EachIsReportedAndNothingIsChanged) {
  const Case c = make_case();
  RegistrationConfig config;
  config.starts.when = OtherStarts::kAlways;
  config.starts.count = 5;
  std::vector<RegistrationIteration> iterations;
  const RegistrationResult watched =
      register_path({&c.path, 1}, test::bumpy_body().surface, c.guess, config, keeping(iterations));
  const RegistrationResult alone = register_path({&c.path, 1}, test::bumpy_body().surface, c.guess, config);
  EXPECT_TRUE(same_bits(watched.T_mesh_world, alone.T_mesh_world));
  EXPECT_EQ(watched.rms_m, alone.rms_m);
  EXPECT_EQ(watched.verdict, alone.verdict);

  ASSERT_FALSE(iterations.empty());
  EXPECT_EQ(iterations.front().phase, RegistrationPhase::kAnnealing);
  // The first begins at the guess; its quaternion is normalised once more, its place goes by way of the points' mean.
  EXPECT_LT(iterations.front().T_mesh_world.rotation.angularDistance(c.guess.rotation), 1e-7);
  EXPECT_LT((iterations.front().T_mesh_world.translation_m - c.guess.translation_m).norm(), 1e-12);
  int main_line = 0, restarts = 0;
  for (const RegistrationIteration& iteration : iterations) {
    main_line += iteration.phase != RegistrationPhase::kRestarts ? 1 : 0;
    restarts = iteration.phase == RegistrationPhase::kRestarts ? std::max(restarts, iteration.start + 1) : restarts;
    EXPECT_LE(iteration.inliers, iteration.points);
    EXPECT_TRUE(std::isfinite(iteration.rms_m));
  }
  EXPECT_EQ(main_line, alone.iterations);  // the result does not count the coarse runs
  EXPECT_EQ(restarts, 6);                  // the fit's own end, and five others
}

TEST(RegistrationIteration, WithoutAGuessAndInTheRefinementToo) {
  const Case c = make_case();
  SearchConfig search;
  search.rotations = 60;
  search.positions = 10;
  search.coarse_runs = 6;
  std::vector<RegistrationIteration> iterations;
  const RegistrationResult found =
      find_registration({&c.path, 1}, test::bumpy_body().surface, search, keeping(iterations));
  EXPECT_TRUE(
      same_bits(found.T_mesh_world, find_registration({&c.path, 1}, test::bumpy_body().surface, search).T_mesh_world));
  EXPECT_EQ(iterations.front().phase, RegistrationPhase::kSearch);

  const MeshSurface surface(test::bumpy_body().mesh);
  const RegistrationResult start = register_path({&c.path, 1}, test::bumpy_body().surface, c.guess, {});
  iterations.clear();
  const RegistrationResult refined =
      refine_registration({&c.path, 1}, surface, start, {}, {}, {}, keeping(iterations)).registration;
  EXPECT_TRUE(same_bits(refined.T_mesh_world,
                        refine_registration({&c.path, 1}, surface, start, {}, {}, {}).registration.T_mesh_world));
  EXPECT_EQ(static_cast<int>(iterations.size()), refined.iterations - start.iterations);
  EXPECT_EQ(iterations.front().phase, RegistrationPhase::kRefinement);
}

TEST(RegistrationIteration, ItIsCancelledFromOneToTheNext) {
  const Case c = make_case();
  const MeshSurface surface(test::bumpy_body().mesh);
  const RegistrationResult start = register_path({&c.path, 1}, test::bumpy_body().surface, c.guess, {});
  std::size_t seen = 0;
  RegistrationObserver observer;
  observer.iterated = [&](const RegistrationIteration&) { ++seen; };
  observer.cancelled = [&] { return seen >= 3; };
  EXPECT_THROW(register_path({&c.path, 1}, test::bumpy_body().surface, c.guess, {}, observer), Cancelled);
  EXPECT_EQ(seen, 3u);
  seen = 0;
  EXPECT_THROW(refine_registration({&c.path, 1}, surface, start, {}, {}, {}, observer), Cancelled);
  EXPECT_EQ(seen, 3u);
  seen = 3;
  EXPECT_THROW(find_registration({&c.path, 1}, test::bumpy_body().surface, {}, observer), Cancelled);
}

}  // namespace
}  // namespace asperity
