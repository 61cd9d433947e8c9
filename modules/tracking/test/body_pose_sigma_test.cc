// The covariance of a body's pose against its errors.

#include "asperity/tracking/solve_body_pose.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include <Eigen/LU>

#include "asperity/base/error.h"
#include "seen_body.h"

namespace asperity {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): this test's own

TEST(SolveBodyPose, TheCovarianceIsThatOfTheErrors) {
  const CameraCalibration camera = known(camera_640());
  const auto body = sleeve(2);
  constexpr int kTrials = 200;
  constexpr double kSigma_px = 0.1;  // as BodyPoseConfig assumes
  Random random(11);
  int within = 0;
  double sum = 0.0;
  Vector6 mean = Vector6::Zero(), covered = Vector6::Zero();
  for (int trial = 0; trial < kTrials; ++trial) {
    const Pose truth = tilted(random.uniform(-30, 30), random.uniform(-20, 20), random.uniform(-180, 180),
                              {random.uniform(-0.05, 0.05), random.uniform(-0.05, 0.05), random.uniform(0.25, 0.6)});
    const auto found = solve_body_pose(camera, body, see(camera, body, truth, kSigma_px, &random), {}, known_body());
    ASSERT_TRUE(found);
    const Vector6 e = error_of(found->T_camera_marker, truth);
    const double d2 = e.dot(found->covariance.ldlt().solve(e));
    sum += d2;
    within += d2 < 17.1 ? 1 : 0;  // 95 % of six times F(6, 14): the variance is estimated from 10 + 4 residuals
    for (int i = 0; i < 6; ++i) {
      const double sigma = std::sqrt(found->covariance(i, i));
      mean[i] += e[i] / sigma / kTrials;
      covered[i] += std::abs(e[i]) < 3.0 * sigma ? 1.0 / kTrials : 0.0;
    }
  }
  std::printf(
      "Mahalanobis² mean %.2f (6), %d of %d within 95 %%; bias/sigma %.2f %.2f %.2f %.2f %.2f %.2f; within 3 sigma "
      "%.3f "
      "%.3f %.3f %.3f %.3f %.3f\n",
      sum / kTrials, within, kTrials, mean[0], mean[1], mean[2], mean[3], mean[4], mean[5], covered[0], covered[1],
      covered[2], covered[3], covered[4], covered[5]);
  // The mean of 200 has a standard deviation of 0.25, more by the estimated variance's tails; a wrong scale of the
  // covariance by 1.3 would show.
  EXPECT_GT(sum / kTrials, 5.0);
  EXPECT_LT(sum / kTrials, 7.8);
  EXPECT_GE(within, 184);
  EXPECT_GE(covered.minCoeff(), 0.97);
  EXPECT_LT(mean.cwiseAbs().maxCoeff(), 0.25);
}

TEST(SolveBodyPose, LargerErrorsThanPromisedShowInTheCovariance) {
  const CameraCalibration camera = known(camera_640());
  const auto body = sleeve(3);
  Random random(12);
  double sum = 0.0;
  constexpr int kTrials = 100;
  for (int trial = 0; trial < kTrials; ++trial) {
    const Pose truth = tilted(random.uniform(-30, 30), random.uniform(-20, 20), 20.0, {0.0, 0.0, 0.4});
    // Five times the corners' own sigma.
    const auto found = solve_body_pose(camera, body, see(camera, body, truth, 0.5, &random), {}, known_body());
    ASSERT_TRUE(found);
    const Vector6 e = error_of(found->T_camera_marker, truth);
    sum += e.dot(found->covariance.ldlt().solve(e)) / kTrials;
  }
  // Unscaled it would be 150.
  EXPECT_LT(sum, 12.0);
  EXPECT_GT(sum, 4.0);
}

// RMS of error over σ, over all six coordinates of `trials` views whose corners `disturb` moves.
template <class Disturb>
double error_over_sigma(const BodyPoseConfig& config, const std::vector<MarkerPlacement>& body, int trials,
                        std::uint64_t seed, const Disturb& disturb) {
  Random random(seed);
  double sum = 0.0;
  for (int trial = 0; trial < trials; ++trial) {
    CameraCalibration drawn = known(camera_640()), believed = drawn;
    const Pose truth = tilted(random.uniform(-30, 30), random.uniform(-20, 20), random.uniform(-180, 180),
                              {random.uniform(-0.05, 0.05), random.uniform(-0.05, 0.05), random.uniform(0.25, 0.6)});
    std::vector<Eigen::Matrix<double, 3, 4>> corners_m;
    for (const MarkerPlacement& tag : body) corners_m.push_back(tag_corners_m(tag));
    disturb(random, believed, corners_m);
    std::vector<SeenTag> seen;
    for (std::size_t t = 0; t < body.size(); ++t) {
      SeenTag tag;
      tag.tag = t;
      for (int i = 0; i < 4; ++i) {
        tag.corners_px.col(i) = *project(drawn, truth * corners_m[t].col(i));
        tag.corners_px.col(i) += 0.02 * Eigen::Vector2d(random.normal(), random.normal());
      }
      tag.covariance_px2 = 0.02 * 0.02 * Eigen::Matrix<double, 8, 8>::Identity();
      tag.has_covariance = true;
      seen.push_back(tag);
    }
    const auto found = solve_body_pose(believed, body, seen, truth, config);
    if (!found) return std::nan("");
    sum += error_of(found->T_camera_marker, truth).cwiseAbs2().cwiseQuotient(found->covariance.diagonal()).sum();
  }
  return std::sqrt(sum / (6.0 * trials));
}

using CornerList = std::vector<Eigen::Matrix<double, 3, 4>>;

TEST(SolveBodyPose, WhatIsWrongInAllFramesIsInTheCovariance) {
  constexpr int kTrials = 100;  // RMS of 100 by some three independent coordinates: to 4 %
  const auto check = [](const char* what, double ratio) {
    std::printf("%s: error over sigma %.2f\n", what, ratio);
    EXPECT_GT(ratio, 0.8) << what;
    EXPECT_LT(ratio, 1.25) << what;
  };
  for (const auto& body : {flat_pair(), sleeve(3)}) {
    BodyPoseConfig config = known_body();
    check("known", error_over_sigma(config, body, kTrials, 21, [](Random&, CameraCalibration&, CornerList&) {}));
    check("focal length",
          error_over_sigma(config, body, kTrials, 22, [](Random& random, CameraCalibration& camera, CornerList&) {
            const double sigma_px = 0.002 * camera.fx;
            (*camera.covariance)(0, 0) = (*camera.covariance)(1, 1) = (*camera.covariance)(0, 1) =
                (*camera.covariance)(1, 0) = sigma_px * sigma_px;
            const double error_px = sigma_px * random.normal();
            camera.fx += error_px;
            camera.fy += error_px;
          }));
    check("centre and distortion",
          error_over_sigma(config, body, kTrials, 23, [](Random& random, CameraCalibration& camera, CornerList&) {
            for (int i : {2, 3}) (*camera.covariance)(i, i) = 1.0;
            (*camera.covariance)(4, 4) = 0.005 * 0.005;
            (*camera.covariance)(6, 6) = 0.0005 * 0.0005;
            camera.cx += random.normal();
            camera.cy += random.normal();
            camera.distortion[0] += 0.005 * random.normal();
            camera.distortion[2] += 0.0005 * random.normal();
          }));
    config.print_scale_error = 0.003;
    check("print scale",
          error_over_sigma(config, body, kTrials, 24, [](Random& random, CameraCalibration&, CornerList& corners_m) {
            const double size = 1.0 + 0.003 * random.normal();
            for (auto& tag : corners_m) tag *= size;
          }));
    config = known_body();
    config.placement_sigma_m = 0.2e-3;
    check("placement",
          error_over_sigma(config, body, kTrials, 25, [](Random& random, CameraCalibration&, CornerList& corners_m) {
            for (auto& tag : corners_m) {
              const Eigen::Vector3d off_m(random.normal(), random.normal(), random.normal());
              tag.colwise() += 0.2e-3 * off_m;
            }
          }));
  }
  BodyPoseConfig config = known_body();
  config.bend_share = 0.002;
  check("bend", error_over_sigma(config, flat_pair(), kTrials, 26,
                                 [](Random& random, CameraCalibration&, CornerList& corners_m) {
                                   const double half_m = 0.052, sag_m = 0.002 * 2.0 * half_m;
                                   const double a = random.normal(), b = random.normal(), c = random.normal();
                                   for (auto& tag : corners_m) {
                                     for (int k = 0; k < 4; ++k) {
                                       const double x = tag(0, k) / half_m, y = tag(1, k) / half_m;
                                       tag(2, k) += sag_m * (a * x * x + b * y * y + std::sqrt(2.0) * c * x * y);
                                     }
                                   }
                                 }));
}

TEST(SolveBodyPose, AnOutlyingFrameSaysSoInItsOwnSigma) {
  // A board of twelve tags whose image is sheared and bulges, as by a rolling shutter or a lens: by 1.5 px.
  std::vector<MarkerPlacement> board;
  for (int i = 0; i < 12; ++i) {
    board.push_back(tag_at(i, {Eigen::Quaterniond::Identity(), {0.06 * (i % 4 - 1.5), 0.06 * (i / 4 - 1.0), 0.0}}));
  }
  const CameraCalibration camera = known(camera_640());
  const BodyPoseConfig config = known_body();
  Random random(31);
  double plain_m = 0.0, odd = 0.0;
  constexpr int kTrials = 40;
  for (int trial = 0; trial < kTrials; ++trial) {
    const Pose truth = tilted(random.uniform(-30, 30), random.uniform(-20, 20), random.uniform(-180, 180),
                              {0.0, 0.0, random.uniform(0.4, 0.8)});
    auto seen = see(camera, board, truth, 0.1, &random);
    const auto plain = solve_body_pose(camera, board, seen, truth, config);
    Eigen::Matrix2d shear;
    for (double& x : shear.reshaped()) x = 1.5 / 100.0 * random.normal();
    const Eigen::Vector2d bulge(1.5 * random.normal(), 1.5 * random.normal());
    for (SeenTag& tag : seen) {
      for (int k = 0; k < 4; ++k) {
        const Eigen::Vector2d at = tag.corners_px.col(k) - Eigen::Vector2d(320.0, 240.0);
        tag.corners_px.col(k) += shear * at + bulge * at.squaredNorm() / (100.0 * 100.0);
      }
    }
    const auto found = solve_body_pose(camera, board, seen, truth, config);
    ASSERT_TRUE(plain && found);
    plain_m += plain->covariance.topLeftCorner<3, 3>().trace() / kTrials;
    odd += error_of(found->T_camera_marker, truth).cwiseAbs2().cwiseQuotient(found->noise.diagonal()).sum() /
           (6.0 * kTrials);
    const auto size = [](const BodyPose& pose) { return pose.noise.topLeftCorner(3, 3).trace(); };
    EXPECT_GT(size(*found), 9.0 * size(*plain));
  }
  std::printf("sheared and bulging: error over sigma %.2f\n", std::sqrt(odd));
  EXPECT_GT(std::sqrt(odd), 0.6);
  EXPECT_LT(std::sqrt(odd), 1.6);
  EXPECT_LT(std::sqrt(plain_m), 1e-3);
}
}  // namespace
}  // namespace asperity
