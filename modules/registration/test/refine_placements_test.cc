#include "asperity/registration/refine_placements.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/SparseCholesky>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "../src/refine_settings.h"
#include "../src/refinement.h"
#include "asperity/registration/placement_likelihood.h"
#include "bumpy_ball.h"

namespace asperity {
namespace {

using Eigen::Vector3d;
using Vector6 = Eigen::Matrix<double, 6, 1>;

const std::array<Pose, 2> kPlaces{
    Pose{Eigen::Quaterniond(Eigen::AngleAxisd(0.4, Vector3d(1, -2, 1).normalized())), Vector3d(0.05, 0.02, -0.3)},
    Pose{Eigen::Quaterniond(Eigen::AngleAxisd(1.9, Vector3d(2, 1, 1).normalized())), Vector3d(-0.04, 0.03, -0.28)}};
const Vector3d kTipSigma_m = Vector3d::Constant(0.1e-3);

// Turn and shift about `centre_m` from the true pose to another.
Vector6 error_of(const Pose& pose, const Pose& truth, const Vector3d& centre_m) {
  const Eigen::Quaterniond turn = pose.rotation * truth.rotation.conjugate();
  Vector6 out;
  out << log_rotation(turn), pose.translation_m - centre_m - turn * (truth.translation_m - centre_m);
  return out;
}

RegistrationResult start_at(const Pose& pose) {
  RegistrationResult out;
  out.T_mesh_world = pose;
  return out;
}

struct Session {
  std::vector<MeasuredPath> paths;
  std::vector<std::size_t> placement_of{0, 0, 1, 1};
  Vector3d tip_m;
};

// Four strokes of one session, two in each placement.
Session session(const MeshSurface& surface, std::uint64_t seed) {
  Random random(seed);
  Session out;
  out.tip_m = kTipSigma_m.cwiseProduct(Vector3d(random.normal(), random.normal(), random.normal()));
  for (std::size_t k = 0; k < 4; ++k) {
    BallStroke stroke;
    stroke.begin_rad = 1.1 * static_cast<double>(k);
    stroke.end_rad = stroke.begin_rad + 1.8;
    stroke.lean_phase = 1.3 * static_cast<double>(k);
    stroke.tip_m = out.tip_m;
    stroke.tip_sigma_m = kTipSigma_m;
    out.paths.push_back(stroke_over_ball(surface, kPlaces[out.placement_of[k]], stroke, 10 * seed + k));
  }
  return out;
}

// The equations' right side is minus half of the cost's gradient: against central differences, for every unknown.
TEST(RefinePlacements, TheGradientIsThatOfTheCost) {
  const MeshSurface surface(bumpy_ball());
  const Session scans = session(surface, 3);
  RefineConfig config;
  config.outlier_sigmas = 1e6;
  const registration::PathChain chain = registration::make_chain(scans.paths, 10e-3, scans.placement_of);
  registration::Refinement problem(
      chain, surface, {{kPlaces[0], Vector3d(0.01, 0, 0), {}}, {kPlaces[1], Vector3d(0, 0.01, 0), {}}}, config);
  // Two links, whose points are near each other by construction of nothing: the gradient does not ask.
  problem.set_overlaps({{20, 300, 0.3, false, 0.2e-3, 300, 301}, {40, 330, 0.7, true, 0.2e-3, 325, 336}});
  registration::State state = registration::zero_state(chain, {kPlaces[0], kPlaces[1]});
  Random random(1);
  for (double& value : state.knots_m) value = 30e-6 * random.normal();
  for (double& value : state.tip_m) value = 50e-6 * random.normal();
  for (double& value : state.level_m) value = 10e-6 * random.normal();
  // No filter over points: the cost is then the sum over all points.
  const std::vector<registration::Whitening> plain(4, registration::Whitening{{}, 400e-12, {20e-6}});
  const registration::FacetHeights heights = problem.heights(state);
  ASSERT_EQ(heights.count, heights.d_m.size());
  const registration::Equations equations = problem.equations(state, heights, plain);
  const double kStep = 1e-8;  // m and rad: a hundredth of the distance to a facet's edge that matters
  std::size_t compared = 0;
  double worst = 0.0, scale = 0.0;
  std::vector<double> differences;
  for (Eigen::Index k = 0; k < problem.size(); ++k) {
    Eigen::VectorXd step = Eigen::VectorXd::Zero(problem.size());
    step[k] = kStep;
    const auto cost = [&](const registration::State& at) { return problem.cost(at, problem.heights(at), plain); };
    const double slope = (cost(problem.moved(state, step)) - cost(problem.moved(state, -step))) / (2.0 * kStep);
    differences.push_back(slope / -2.0 - equations.right[k]);
    scale = std::max(scale, std::abs(equations.right[k]));
    ++compared;
  }
  EXPECT_GT(compared, 60U);
  for (const double difference : differences) worst = std::max(worst, std::abs(difference));
  // A link's direction turns with its points, which the gradient leaves out; and facets' edges.
  EXPECT_LT(worst, 0.02 * scale);
}

TEST(RefinePlacements, TheCovarianceHoldsAndTheTipIsFound) {
  const MeshSurface surface(bumpy_ball());
  constexpr int kTrials = 10;
  double pose = 0.0, tip = 0.0, before_m2 = 0.0, after_m2 = 0.0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const Session scans = session(surface, 20 + static_cast<std::uint64_t>(trial));
    const std::vector<RegistrationResult> starts{start_at(kPlaces[0]), start_at(kPlaces[1])};
    const RefinedPlacements found = refine_placements(scans.paths, scans.placement_of, surface, starts, {}, {});
    for (std::size_t k = 0; k < 2; ++k) {
      const RegistrationResult& result = found.registrations[k];
      const Vector6 error = error_of(result.T_mesh_world, kPlaces[k], result.centre_mesh_m);
      pose += error.dot(result.covariance.ldlt().solve(error)) / (2.0 * kTrials);
    }
    tip += (found.tip_shift_m[0] - scans.tip_m).cwiseQuotient(found.tip_sigma_m[0]).squaredNorm() / kTrials;
    after_m2 += (found.tip_shift_m[0] - scans.tip_m).squaredNorm();
    before_m2 += scans.tip_m.squaredNorm();
    EXPECT_EQ(found.tip_shift_m[0], found.tip_shift_m[3]);  // one session, one tip
  }
  // Means of 6 and 3, standard deviations over the trials 0.8 and 0.8; the kinks are not linear in the pose.
  EXPECT_GT(pose, 3.0);
  EXPECT_LT(pose, 10.0);
  EXPECT_GT(tip, 0.8);
  EXPECT_LT(tip, 6.0);
  EXPECT_LT(after_m2, 0.8 * before_m2);
}

TEST(RefinePlacements, TheSameInputGivesTheSameBytes) {
  const MeshSurface surface(bumpy_ball());
  const Session scans = session(surface, 4);
  const std::vector<RegistrationResult> starts{start_at(kPlaces[0]), start_at(kPlaces[1])};
  const auto run = [&] { return refine_placements(scans.paths, scans.placement_of, surface, starts, {}, {}); };
  const RefinedPlacements a = run(), b = run();
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(a.registrations[k].T_mesh_world.translation_m, b.registrations[k].T_mesh_world.translation_m);
    EXPECT_EQ(a.registrations[k].covariance, b.registrations[k].covariance);
  }
}

// Where the slow errors moved two strokes against each other along the path, the textures know.
TEST(RefinePlacements, StrokesBesideEachOtherAreAlignedByTheirTexture) {
  const MeshSurface surface(bumpy_ball());
  const auto shift_between = [&](std::uint64_t seed, double overlap_m) {
    BallStroke stroke;
    stroke.relief_m = 0.1e-3;  // above what the slow error, which is rough in this model, makes over a few millimetres
    std::vector<MeasuredPath> paths{stroke_over_ball(surface, kPlaces[0], stroke, seed)};
    stroke.across_m = 0.05e-3;
    paths.push_back(stroke_over_ball(surface, kPlaces[0], stroke, seed + 50));
    stroke.slow_m = 0.0;
    stroke.white_m = 0.0;
    const MeasuredPath exact = stroke_over_ball(surface, kPlaces[0], stroke, 1);
    RefineConfig config;
    config.overlap_m = overlap_m;
    const std::vector<RegistrationResult> starts{start_at(kPlaces[0])};
    const RefinedPlacements found =
        refine_placements(paths, std::vector<std::size_t>{0, 0}, surface, starts, {}, config);
    EXPECT_EQ(found.shifts > 0, overlap_m > 0.0);
    // RMS difference of what is left of either stroke's slow error along the path.
    double sum_m2 = 0.0;
    std::size_t count = 0;
    const std::size_t n = std::min({paths[0].p_world_m.size(), paths[1].p_world_m.size(), exact.p_world_m.size()});
    for (std::size_t i = 20; i + 20 < n; ++i) {
      const Vector3d along = (exact.p_world_m[i + 1] - exact.p_world_m[i - 1]).normalized();
      const Vector3d between = (paths[0].p_world_m[i] - found.slow_error_world_m[0][i]) -
                               (paths[1].p_world_m[i] - found.slow_error_world_m[1][i]);
      sum_m2 += std::pow(along.dot(between), 2);
      ++count;
    }
    return std::sqrt(sum_m2 / static_cast<double>(count));
  };
  double with_m = 0.0, without_m = 0.0;
  constexpr std::uint64_t kTrials = 8;
  for (std::uint64_t seed = 1; seed <= kTrials; ++seed) {
    with_m += shift_between(seed, 0.3e-3) / kTrials;
    without_m += shift_between(seed, 0.0) / kTrials;
  }
  EXPECT_GT(without_m, 80e-6);  // 0.1 mm each, both kept
  // Of 24 trials the means have a ratio of 0.59, and one trial varies by 0.1: three standard errors of eight are 0.11.
  EXPECT_LT(with_m, 0.7 * without_m);
}

TEST(PlacementLikelihood, StrokesOfOnePlacementShareItAndOfTwoDoNot) {
  const MeshSurface surface(bumpy_ball());
  const RegistrationSurface ready = prepare_surface(surface.mesh, surface.bvh);
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    const Session scans = session(surface, 60 + seed);
    const auto fit = [&](std::initializer_list<std::size_t> members) {
      std::vector<MeasuredPath> paths;
      for (const std::size_t k : members) paths.push_back(scans.paths[k]);
      return fit_placement(paths, ready, kPlaces, {}, {}).log_evidence;
    };
    const auto log_odds = [&](std::size_t a, std::size_t b) { return fit({a, b}) - fit({a}) - fit({b}); };
    EXPECT_GT(log_odds(0, 1), 5.0) << seed;
    EXPECT_GT(log_odds(2, 3), 5.0) << seed;
    EXPECT_LT(log_odds(1, 2), -50.0) << seed;
  }
}

}  // namespace
}  // namespace asperity
