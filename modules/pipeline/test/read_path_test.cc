#include "asperity/pipeline/read_path.h"

#include <string>

#include <gtest/gtest.h>

#include "asperity/base/error.h"

namespace asperity {
namespace {

TEST(ReadPath, StandardDeviationsBecomeCovariances) {
  const PathFile path = parse_path(
      "px_m,py_m,pz_m,sigma_m,sigma_x_m,sigma_y_m,sigma_z_m\n"
      "0,0,0,9,1e-4,2e-4,3e-4\n"
      "1,0,0,9,4e-4,5e-4,6e-4\n",
      "a.csv");
  ASSERT_EQ(path.motion.cov_world_tip_m2.size(), 2U);
  // Squares on the diagonal; the columns of the axes say more than the one of all.
  EXPECT_EQ(path.motion.cov_world_tip_m2[0],
            Eigen::Matrix3d(Eigen::Vector3d(1e-4 * 1e-4, 2e-4 * 2e-4, 3e-4 * 3e-4).asDiagonal()));
  EXPECT_EQ(path.motion.cov_world_tip_m2[1](2, 2), 6e-4 * 6e-4);
  EXPECT_TRUE(path.problems.empty());
}

TEST(ReadPath, OneStandardDeviationIsThatOfEachAxis) {
  const PathFile path = parse_path("px_m,py_m,pz_m,sigma_m\n0,0,0,2e-4\n", "a.csv");
  ASSERT_EQ(path.motion.cov_world_tip_m2.size(), 1U);
  EXPECT_EQ(path.motion.cov_world_tip_m2[0], Eigen::Matrix3d(4e-8 * Eigen::Matrix3d::Identity()));
}

TEST(ReadPath, WithoutThemOrWithAGapNoErrorIsStated) {
  EXPECT_TRUE(parse_path("px_m,py_m,pz_m\n0,0,0\n", "a.csv").motion.cov_world_tip_m2.empty());
  const PathFile gap = parse_path("px_m,py_m,pz_m,sigma_m\n0,0,0,1e-4\n1,0,0,nan\n", "a.csv");
  EXPECT_TRUE(gap.motion.cov_world_tip_m2.empty());
  ASSERT_EQ(gap.problems.size(), 1U);
  EXPECT_EQ(gap.problems[0].kind, "no_error");
  // The raw methods write nan in all rows: nothing is stated, and nothing is wrong with the file.
  const PathFile none = parse_path("px_m,py_m,pz_m,sigma_m\n0,0,0,nan\n1,0,0,nan\n", "a.csv");
  EXPECT_TRUE(none.motion.cov_world_tip_m2.empty());
  EXPECT_TRUE(none.problems.empty());
}

TEST(ReadPath, WhatIsNoStandardDeviationIsRefused) {
  EXPECT_THROW(parse_path("px_m,py_m,pz_m,sigma_m\n0,0,0,-1e-4\n", "a.csv"), Error);
  EXPECT_THROW(parse_path("px_m,py_m,pz_m,sigma_m\n0,0,0,inf\n", "a.csv"), Error);
  EXPECT_THROW(parse_path("px_m,py_m,pz_m,sigma_x_m\n0,0,0,1e-4\n", "a.csv"), Error);  // two axes are missing
}

}  // namespace
}  // namespace asperity
