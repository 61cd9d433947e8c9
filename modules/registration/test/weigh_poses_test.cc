#include "asperity/registration/weigh_poses.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <Eigen/Cholesky>

#include "asperity/registration/find_registration.h"
#include "asperity/registration/pose_rivals.h"
#include "symmetric_bodies.h"
#include "test_surfaces.h"

namespace asperity {
namespace {

using test::Body;
using test::kWorldMesh;

// Over a plane the heights are the points' z: the likelihood is that of a normal distribution with the covariance that
// weigh_poses.h describes, written out.
TEST(WeighPoses, TheLikelihoodOverAPlaneIsThatOfADenseCovariance) {
  const Body plane(
      test::grid(4, 4, [](double u, double v) { return Eigen::Vector3d(0.4 * u - 0.2, 0.4 * v - 0.2, 0.0); }));
  Random random(4);
  MeasuredPath path;
  double slow_m = 0.1e-3 * random.normal();
  for (int i = 0; i < 400; ++i) {
    slow_m = std::exp(-0.25 / 20.0) * slow_m + std::sqrt(1.0 - std::exp(-0.5 / 20.0)) * 0.1e-3 * random.normal();
    path.p_world_m.emplace_back(0.25e-3 * i - 50e-3, 1e-3, slow_m + 5e-6 * random.normal());
  }
  path.slow_covariance_world_m2 = 1e-8 * Eigen::Matrix3d::Identity();
  const WeighConfig config;
  const auto cost_at = [&](double shift_m) {
    return weigh_pose({&path, 1}, plane.surface, {Eigen::Quaterniond::Identity(), {0.0, 0.0, shift_m}}, {}, config, {});
  };
  for (const double shift_m : {0.0, 0.15e-3}) {
    const WeighedPose at = cost_at(shift_m);
    // Blocks of 8 points; of each the second, fourth, sixth and eighth by the even spread.
    constexpr int kBlocks = 50;
    Eigen::VectorXd d_m(kBlocks), s_m(kBlocks);
    for (int b = 0; b < kBlocks; ++b) {
      d_m[b] = shift_m;
      for (const int k : {1, 3, 5, 7}) d_m[b] += 0.25 * path.p_world_m[static_cast<std::size_t>(8 * b + k)].z();
      s_m[b] = 2e-3 * b;
    }
    Eigen::MatrixXd covariance(kBlocks, kBlocks);
    const double noise_m2 = at.noise_m * at.noise_m;
    for (int i = 0; i < kBlocks; ++i) {
      for (int k = 0; k < kBlocks; ++k) {
        covariance(i, k) = 1e-8 * at.slow_ratio * at.slow_ratio * std::exp(-std::abs(s_m[i] - s_m[k]) / 20e-3) +
                           config.relief_mean_ratio * config.relief_mean_ratio * noise_m2 + (i == k ? noise_m2 : 0.0);
      }
    }
    const Eigen::LLT<Eigen::MatrixXd> factor(covariance);
    const Eigen::MatrixXd L = factor.matrixL();
    const double expected = d_m.dot(factor.solve(d_m)) + 2.0 * L.diagonal().array().log().sum() +
                            std::pow(std::log(at.slow_ratio) / config.slow_ratio_spread, 2);
    // The points' own spacing along x is not quite that of the blocks' first points: a thousandth of the cost.
    EXPECT_NEAR(at.fit, expected, 1e-3 * std::abs(expected)) << shift_m;
  }
}

// Over a plane three motions of the pose show in the heights. With their columns J and the prior Λ the restricted
// likelihood of the slow error's size τ is −2 log L + log |JᵀΣ⁻¹J + Λ| (Patterson and Thompson 1971), written out with
// dense matrices over a grid of τ. A path of two correlation lengths has few degrees of freedom: the likelihood alone
// would find a τ that is too small.
TEST(WeighPoses, TheSlowErrorsSizeIsThatOfTheRestrictedLikelihood) {
  const Body plane(
      test::grid(4, 4, [](double u, double v) { return Eigen::Vector3d(0.4 * u - 0.2, 0.4 * v - 0.2, 0.0); }));
  constexpr int kBlocks = 25;
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    Random random(seed);
    MeasuredPath path;
    double slow_m = 0.1e-3 * random.normal();
    for (int i = 0; i < 8 * kBlocks; ++i) {
      slow_m = std::exp(-0.25 / 20.0) * slow_m + std::sqrt(1.0 - std::exp(-0.5 / 20.0)) * 0.1e-3 * random.normal();
      path.p_world_m.emplace_back(0.25e-3 * i - 25e-3, 4e-3 * std::sin(0.05 * i), slow_m + 5e-6 * random.normal());
    }
    path.slow_covariance_world_m2 = 1e-8 * Eigen::Matrix3d::Identity();
    const WeighConfig config;
    const WeighedPose at = weigh_pose({&path, 1}, plane.surface, {}, {}, config, {});
    Eigen::Vector3d mean_m = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& p_m : path.p_world_m) mean_m += p_m / (8.0 * kBlocks);
    double radius2_m2 = 0.0;
    Eigen::Matrix<double, 6, 6> metric = Eigen::Matrix<double, 6, 6>::Zero();
    for (const Eigen::Vector3d& p_m : path.p_world_m) {
      Eigen::Matrix<double, 3, 6> motion;
      motion << -skew(p_m - mean_m), Eigen::Matrix3d::Identity();
      metric += motion.transpose() * motion / (8.0 * kBlocks);
      radius2_m2 += (p_m - mean_m).squaredNorm() / (8.0 * kBlocks);
    }
    metric /= 0.25 * radius2_m2;
    Eigen::VectorXd d_m(kBlocks), s_m(kBlocks);
    Eigen::MatrixXd rows(kBlocks, 6);
    double at_m = 0.0;
    for (int b = 0; b < kBlocks; ++b) {
      Eigen::Vector3d middle_m = Eigen::Vector3d::Zero();
      for (const int k : {1, 3, 5, 7}) middle_m += 0.25 * path.p_world_m[static_cast<std::size_t>(8 * b + k)];
      d_m[b] = middle_m.z();
      rows.row(b) << (middle_m - mean_m).cross(Eigen::Vector3d::UnitZ()).transpose(), 0.0, 0.0, 1.0;
      s_m[b] = at_m;
      for (int k = 8 * b; k < 8 * b + 8 && k + 1 < 8 * kBlocks; ++k) {
        at_m += (path.p_world_m[static_cast<std::size_t>(k + 1)] - path.p_world_m[static_cast<std::size_t>(k)]).norm();
      }
    }
    const double noise_m2 = at.noise_m * at.noise_m;
    double best = 1e300, best_plain = 1e300, ratio = 0.0, plain = 0.0;
    for (double log_ratio = -1.2; log_ratio < 2.0; log_ratio += 0.02) {
      Eigen::MatrixXd covariance(kBlocks, kBlocks);
      for (int i = 0; i < kBlocks; ++i) {
        for (int k = 0; k < kBlocks; ++k) {
          covariance(i, k) = 1e-8 * std::exp(2.0 * log_ratio) * std::exp(-std::abs(s_m[i] - s_m[k]) / 20e-3) +
                             config.relief_mean_ratio * config.relief_mean_ratio * noise_m2 + (i == k ? noise_m2 : 0.0);
        }
      }
      const Eigen::LLT<Eigen::MatrixXd> factor(covariance);
      const Eigen::MatrixXd L = factor.matrixL();
      const double likelihood = d_m.dot(factor.solve(d_m)) + 2.0 * L.diagonal().array().log().sum() +
                                std::pow(log_ratio / config.slow_ratio_spread, 2);
      const Eigen::Matrix<double, 6, 6> precision = rows.transpose() * factor.solve(rows) + metric;
      const double restricted = likelihood + precision.ldlt().vectorD().array().log().sum();
      if (restricted < best) {
        best = restricted;
        ratio = std::exp(log_ratio);
      }
      if (likelihood < best_plain) {
        best_plain = likelihood;
        plain = std::exp(log_ratio);
      }
    }
    // Found on a grid of factors of 1.12 above one of 1.19: half a step of either.
    EXPECT_LT(std::abs(std::log(at.slow_ratio / ratio)), 0.12) << seed;
    EXPECT_GT(ratio, 1.02 * plain) << seed;
    // A path of 50 mm has some 5 to 25 values of its error that are its own: 1/√(2ν).
    EXPECT_GT(at.slow_ratio_sigma, 0.1) << seed;
    EXPECT_LT(at.slow_ratio_sigma, 0.5) << seed;
  }
}

TEST(WeighPoses, TheTruthIsLikelierThanAValleyNearby) {
  const Body& body = test::bumpy_body();
  const auto p_m = test::bumpy_path(body, 800);
  Random random(3);
  const MeasuredPath path = test::measured(p_m, 0.1e-3, random);
  std::vector<Pose> candidates;
  for (int i = 0; i < 4; ++i) candidates.push_back(test::perturbed(kWorldMesh.inverse(), p_m, 1e-3, 1.0, random));
  candidates.push_back(Pose{exp_rotation({0.0, 0.0, std::numbers::pi}), {0, 0, 0}} * kWorldMesh.inverse());
  const auto found = weigh_poses({&path, 1}, body.surface, candidates, {}, {}, {});
  // The four begin in one valley and end as one pose.
  ASSERT_FALSE(found.empty());
  EXPECT_LE(found.size(), 2U);
  EXPECT_LT(test::pose_error_m(found.front().T_mesh_world, kWorldMesh, p_m), 0.3e-3);
  if (found.size() > 1) {
    EXPECT_LT(found[1].log_mass, found[0].log_mass - 10.0);
  }
}

// A way round a prism's side, over two of its edges.
std::vector<Eigen::Vector3d> over_prism(const Body& prism) {
  std::vector<Eigen::Vector3d> out;
  for (int i = 0; i < 700; ++i) {
    const double t = i / 699.0;
    const double angle = 0.4 + 3.4 * t, z_m = 22e-3 * std::sin(9.0 * t);
    out.emplace_back(40e-3 * std::cos(angle), 40e-3 * std::sin(angle), z_m);
  }
  for (int i = 0; i < 200; ++i) out.emplace_back(10e-3 - 20e-3 * i / 199.0, 8e-3 * std::sin(0.03 * i), 31e-3);
  return test::laid_on(prism, out);
}

TEST(FindRivals, CopiesByTheMeshesOwnSymmetryAreNone) {
  const Body prism(test::prism_mesh(3, 40e-3, 60e-3));
  const auto p_m = over_prism(prism);
  Random random(8);
  const MeasuredPath path = test::measured(p_m, 0.05e-3, random);
  std::vector<Pose> candidates;
  for (int k = 0; k < 3; ++k) {
    candidates.push_back(Pose{exp_rotation({0.0, 0.0, 2.0 * std::numbers::pi * k / 3.0}), {0, 0, 0}} *
                         kWorldMesh.inverse());
  }
  const auto found = weigh_poses({&path, 1}, prism.surface, candidates, {}, {}, {});
  ASSERT_EQ(found.size(), 3U);
  const PoseRivals rivals = find_rivals({&path, 1}, prism.surface, found[0], found, true, {});
  EXPECT_EQ(rivals.symmetric_copies, 2U);
  EXPECT_EQ(rivals.odds, 0.0);
  EXPECT_LT(rivals.sigma_m, 0.5e-3);
}

// Round the side of the sphere that has no bump (that is at +x): each rotation that keeps the path off it fits as well,
// and is another pose all the same, but for those about x.
TEST(FindRivals, WhatThePathDoesNotTouchDoesNotMakeItSymmetric) {
  const Body bumped(test::sphere_mesh(35e-3, 2e-3));
  std::vector<Eigen::Vector3d> p_m;
  for (int i = 0; i < 600; ++i) {
    const double t = i / 599.0;
    p_m.emplace_back(-35e-3 * std::cos(1.2 * t), 35e-3 * std::sin(1.2 * t), 8e-3 * std::sin(7.0 * t));
  }
  p_m = test::laid_on(bumped, p_m);
  Random random(8);
  const MeasuredPath path = test::measured(p_m, 0.05e-3, random);
  const Pose truth = kWorldMesh.inverse();
  const std::vector<Pose> candidates{truth, Pose{exp_rotation({0.0, 0.0, 0.5}), {0, 0, 0}} * truth};
  const auto found = weigh_poses({&path, 1}, bumped.surface, candidates, {}, {}, {});
  const PoseRivals rivals = find_rivals({&path, 1}, bumped.surface, found[0], found, true, {});
  EXPECT_EQ(rivals.symmetric_copies, 0U);
  EXPECT_FALSE(rivals.symmetric_motion);
  EXPECT_TRUE(rivals.odds > 0.01 || rivals.sigma_rad > 0.03) << rivals.odds << " " << rivals.sigma_rad;
}

TEST(FindRivals, OnAnotherMeshThePathNeedsALargeErrorOrFitsInManyPlaces) {
  const Body& body = test::bumpy_body();
  const auto p_m = test::bumpy_path(body, 800);
  Random random(5);
  const MeasuredPath path = test::measured(p_m, 0.1e-3, random);
  const Body other(test::grid(80, 160, [](double u, double v) {
    const Eigen::Vector3d d = test::spherical(u, v);
    return Eigen::Vector3d(40e-3 * d.x(), 34e-3 * d.y(), 28e-3 * d.z());
  }));
  const auto poses = find_poses({&path, 1}, other.surface, {});
  const auto found = weigh_poses({&path, 1}, other.surface, poses, {}, {}, {});
  const PoseRivals rivals = find_rivals({&path, 1}, other.surface, found[0], found, true, {});
  EXPECT_TRUE(rivals.odds > 0.01 || rivals.slow_ratio > 3.5) << rivals.odds << " " << rivals.slow_ratio;
}

TEST(FindRivals, OddsBeyondTheRangeOfNumbersAreStated) {
  // e⁻¹⁵⁰⁰ is no number: it is stated as a logarithm.
  PoseRivals rivals;
  rivals.rival = RunnerUp{};
  rivals.odds = 0.0;
  rivals.log_odds = -1500.0;
  RegistrationResult result;
  state_rivals(rivals, result);
  EXPECT_NE(result.verdict.find("e^1500.0"), std::string::npos) << result.verdict;
  EXPECT_EQ(result.verdict.find("inf"), std::string::npos) << result.verdict;
}

}  // namespace
}  // namespace asperity
