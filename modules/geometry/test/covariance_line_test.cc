// One covariance a sample, held or between nodes.

#include "asperity/geometry/covariance_line.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

#include "asperity/base/random.h"

namespace asperity {
namespace {

using Eigen::Matrix3d;

TEST(CovarianceLine, BetweenNodesItIsTheMatricesThatItStandsFor) {
  Random random(11);
  std::vector<Matrix3d> nodes(5);
  for (Matrix3d& node : nodes) {
    for (double& element : node.reshaped()) element = random.normal();
  }
  CovarianceLine line = CovarianceLine::between(nodes, 17);
  EXPECT_TRUE(line.empty());
  std::vector<Matrix3d> each;
  for (std::size_t k = 0; k + 1 < nodes.size(); ++k) {
    for (const double share : {0.0, 0.25, 0.7, 1.0}) {
      line.push_between(k, share);
      each.push_back((1.0 - share) * nodes[k] + share * nodes[k + 1]);
    }
  }
  line.push_between(4, 0.0);
  each.push_back(nodes[4]);
  ASSERT_EQ(line.size(), each.size());
  for (std::size_t i = 0; i < each.size(); ++i) EXPECT_EQ(line[i], each[i]) << i;
  EXPECT_EQ(line.back(), nodes[4]);
  EXPECT_THROW(line.at(each.size()), std::out_of_range);

  // Changed in one place the others stay, to the last bit.
  line.set(3, Matrix3d::Identity());
  line.push_back(2.0 * Matrix3d::Identity());
  each[3].setIdentity();
  each.emplace_back(2.0 * Matrix3d::Identity());
  std::size_t i = 0;
  for (const Matrix3d& covariance : line) EXPECT_EQ(covariance, each[i++]);
  EXPECT_EQ(i, each.size());
}

TEST(CovarianceLine, AnAppendedLineFollowsTheFirst) {
  CovarianceLine line{Matrix3d::Identity()};
  CovarianceLine more = CovarianceLine::between({Matrix3d::Zero(), 4.0 * Matrix3d::Identity()}, 1);
  more.push_between(0, 0.5);
  line.append(more);
  ASSERT_EQ(line.size(), 2u);
  EXPECT_EQ(line[1], 2.0 * Matrix3d::Identity());
  line.clear();
  EXPECT_TRUE(line.empty());
}

}  // namespace
}  // namespace asperity
