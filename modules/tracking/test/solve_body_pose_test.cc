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

TEST(SolveBodyPose, ExactCornersGiveTheExactPose) {
  const CameraCalibration camera = camera_640();
  for (const auto& body : {flat_pair(), sleeve(2), sleeve(3), std::vector<MarkerPlacement>{flat_pair()[0]}}) {
    for (const double turn_deg : {0.0, 77.0, 180.0, -130.0}) {
      const Pose truth = tilted(25.0, -18.0, turn_deg, {0.03, -0.02, 0.35});
      const auto found = solve_body_pose(camera, body, see(camera, body, truth));
      ASSERT_TRUE(found);
      EXPECT_TRUE(found->converged);
      EXPECT_EQ(found->tags_used, static_cast<int>(body.size()));
      EXPECT_LT(error_of(found->T_camera_marker, truth).norm(), 1e-8);  // m and rad
      EXPECT_LT(found->reprojection_px, 1e-5);
    }
  }
}

TEST(SolveBodyPose, AnOccludedCornerDoesNotDragThePose) {
  const CameraCalibration camera = camera_640();
  const auto body = sleeve(2);
  const Pose truth = tilted(20.0, 10.0, 30.0, {0.01, 0.02, 0.3});
  Random random(13);
  auto seen = see(camera, body, truth, 0.05, &random);
  seen[0].corners_px.col(2) += Eigen::Vector2d(9.0, -6.0);
  const auto found = solve_body_pose(camera, body, seen);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->corners_used, 7);
  const Vector6 e = error_of(found->T_camera_marker, truth);
  EXPECT_LT(e.head<3>().norm(), 0.3e-3);
  EXPECT_LT(e.tail<3>().norm(), 0.3 * kDegree);
}

TEST(SolveBodyPose, AWronglyReadTagIsLeftOut) {
  const CameraCalibration camera = camera_640();
  const auto body = sleeve(3);
  const Pose truth = tilted(-15.0, 12.0, 100.0, {0.0, -0.02, 0.4});
  Random random(14);
  auto seen = see(camera, body, truth, 0.05, &random);
  // The third tag's number is read from a square elsewhere in the image, and it is the largest.
  seen[2].corners_px << 40.0, 190.0, 185.0, 35.0, 300.0, 305.0, 440.0, 445.0;
  const auto found = solve_body_pose(camera, body, seen);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->used, (std::vector<bool>{true, true, false}));
  EXPECT_LT(error_of(found->T_camera_marker, truth).head<3>().norm(), 0.5e-3);
}

TEST(SolveBodyPose, ASecondCopyOfATagIsLeftOut) {
  const CameraCalibration camera = camera_640();
  const auto body = sleeve(2);
  const Pose truth = tilted(10.0, 5.0, 0.0, {0.02, 0.0, 0.35});
  auto seen = see(camera, body, truth);
  SeenTag copy = seen[1];
  copy.corners_px.colwise() += Eigen::Vector2d(-180.0, 60.0);
  seen.push_back(copy);
  const auto found = solve_body_pose(camera, body, seen);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->used, (std::vector<bool>{true, true, false}));
  EXPECT_LT(error_of(found->T_camera_marker, truth).norm(), 1e-6);
}

TEST(SolveBodyPose, ThePredictionTellsTheTwoWaysOfAPlaneApart) {
  const CameraCalibration camera = camera_640();
  const std::vector<MarkerPlacement> body{flat_pair()[0]};
  Random random(15);
  int ambiguous = 0, wrong = 0;
  for (int trial = 0; trial < 60; ++trial) {
    // Far off and slightly turned away: here the two poses explain the noisy corners alike.
    const Pose truth = tilted(random.uniform(-12, 12), random.uniform(-12, 12), 20.0, {0.0, 0.0, 0.6});
    const auto seen = see(camera, body, truth, 0.15, &random);
    const auto found = solve_body_pose(camera, body, seen, truth);
    ASSERT_TRUE(found);
    ambiguous += found->ambiguous ? 1 : 0;
    if (found->runner_up) {
      const double best = error_of(found->T_camera_marker, truth).tail<3>().norm();
      wrong += found->ambiguous && best > error_of(*found->runner_up, truth).tail<3>().norm() + 1e-9 ? 1 : 0;
    }
  }
  EXPECT_GT(ambiguous, 10);
  EXPECT_EQ(wrong, 0);
}

TEST(SolveBodyPose, TagsInTwoPlanesAreNotAmbiguous) {
  const CameraCalibration camera = camera_640();
  const auto body = sleeve(2);
  Random random(16);
  for (int trial = 0; trial < 40; ++trial) {
    const Pose truth = tilted(random.uniform(-25, 25), random.uniform(-15, 15), 20.0, {0.0, 0.0, 0.5});
    const auto found = solve_body_pose(camera, body, see(camera, body, truth, 0.1, &random));
    ASSERT_TRUE(found);
    EXPECT_FALSE(found->ambiguous);
    EXPECT_LT(error_of(found->T_camera_marker, truth).tail<3>().norm(), 3.0 * kDegree);
  }
}

TEST(SolveBodyPose, ABodyScaledByAPowerOfTwoGivesThePoseScaled) {
  const CameraCalibration camera = camera_640();
  auto body = sleeve(2);
  const Pose truth = tilted(20.0, 10.0, 30.0, {0.01, 0.02, 0.3});
  Random random(17);
  const auto seen = see(camera, body, truth, 0.1, &random);
  const auto small = solve_body_pose(camera, body, seen);
  for (MarkerPlacement& tag : body) {
    tag.size_m *= 1024.0;
    tag.T_marker_tag.translation_m *= 1024.0;
  }
  const auto large = solve_body_pose(camera, body, seen);
  ASSERT_TRUE(small && large);
  // Both end within a thousandth of a standard error of the same minimum.
  const double sigma_m = std::sqrt(small->covariance.topLeftCorner<3, 3>().trace());
  EXPECT_LT((large->T_camera_marker.translation_m / 1024.0 - small->T_camera_marker.translation_m).norm(),
            1e-2 * sigma_m);
}

TEST(SolveBodyPose, WhatCannotBeSolvedIsSaid) {
  const CameraCalibration camera = camera_640();
  const auto body = flat_pair();
  EXPECT_FALSE(solve_body_pose(camera, body, {}));
  std::vector<SeenTag> seen = see(camera, body, tilted(0, 0, 0, {0, 0, 0.4}));
  seen[0].tag = 2;
  EXPECT_THROW(solve_body_pose(camera, body, seen), Error);
  seen[0].tag = 0;
  seen[0].corners_px(0, 0) = std::nan("");
  EXPECT_THROW(solve_body_pose(camera, body, seen), Error);
  // Four corners on a line are no square.
  SeenTag line;
  line.corners_px << 100, 110, 120, 130, 50, 50, 50, 50;
  const auto degenerate = solve_body_pose(camera, {body[0]}, std::vector<SeenTag>{line});
  if (degenerate) {
    EXPECT_TRUE(degenerate->covariance.allFinite());
  }
}

}  // namespace
}  // namespace asperity
