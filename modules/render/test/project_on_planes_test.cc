#include "project_on_planes.h"

#include <optional>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include "asperity/base/random.h"

namespace asperity {
namespace {

using Eigen::Vector3d;

bool fulfils(const std::vector<HalfSpace>& planes, const Vector3d& x, double tolerance) {
  for (const HalfSpace& plane : planes)
    if (plane.depth_m(x) > tolerance) return false;
  return true;
}

// The nearest point of all that lie on up to three of the planes and violate none.
std::optional<Vector3d> by_enumeration(const std::vector<HalfSpace>& planes, const Vector3d& goal) {
  std::optional<Vector3d> best;
  const auto try_set = [&](const std::vector<std::size_t>& set) {
    Eigen::MatrixXd n(static_cast<Eigen::Index>(set.size()), 3);
    Eigen::VectorXd short_of(static_cast<Eigen::Index>(set.size()));
    for (Eigen::Index k = 0; k < n.rows(); ++k) {
      n.row(k) = planes[set[static_cast<std::size_t>(k)]].normal.transpose();
      short_of[k] = planes[set[static_cast<std::size_t>(k)]].depth_m(goal);
    }
    const Vector3d x = set.empty() ? goal : Vector3d(goal + n.transpose() * (n * n.transpose()).inverse() * short_of);
    if (!x.allFinite() || !fulfils(planes, x, 1e-9)) return;
    if (!best || (x - goal).norm() < (*best - goal).norm()) best = x;
  };
  try_set({});
  for (std::size_t i = 0; i < planes.size(); ++i) {
    try_set({i});
    for (std::size_t j = i + 1; j < planes.size(); ++j) {
      try_set({i, j});
      for (std::size_t k = j + 1; k < planes.size(); ++k) try_set({i, j, k});
    }
  }
  return best;
}

TEST(ProjectOnPlanes, IsTheNearestOfAllActiveSets) {
  Random random(7);
  for (int round = 0; round < 2000; ++round) {
    // All planes have the origin inside, so that there is an answer.
    std::vector<HalfSpace> planes(1 + static_cast<std::size_t>(random.uniform() * 7.0));
    for (HalfSpace& plane : planes) {
      plane.normal = Vector3d(random.normal(), random.normal(), random.normal()).normalized();
      plane.offset_m = -random.uniform();
    }
    const Vector3d goal = 3.0 * Vector3d(random.normal(), random.normal(), random.normal());
    PlaneProjection projection(goal);
    for (int step = 0; step < 100; ++step) {
      int worst = -1;
      double depth = 1e-12;
      for (std::size_t k = 0; k < planes.size(); ++k)
        if (planes[k].depth_m(projection.x_m()) > depth)
          depth = planes[k].depth_m(projection.x_m()), worst = static_cast<int>(k);
      if (worst < 0) break;
      ASSERT_TRUE(projection.add(planes[static_cast<std::size_t>(worst)], worst));
    }
    const std::optional<Vector3d> expected = by_enumeration(planes, goal);
    ASSERT_TRUE(expected.has_value());
    EXPECT_LT((projection.x_m() - *expected).norm(), 1e-7) << round;  // corners may be acute
    Vector3d pull = Vector3d::Zero();
    for (int i = 0; i < projection.size(); ++i)
      pull += projection.active(i).multiplier_m * projection.active(i).plane.normal;
    EXPECT_LT((projection.x_m() - goal - pull).norm(), 1e-7);
  }
}

TEST(ProjectOnPlanes, OfParallelPlanesTheDeeperStays) {
  PlaneProjection projection(Vector3d(0.3, 0.4, -1.0));
  ASSERT_TRUE(projection.add({Vector3d::UnitZ(), 0.0}, 0));
  ASSERT_TRUE(projection.add({Vector3d(1e-12, 0.0, 1.0), 0.5}, 1));
  EXPECT_EQ(projection.size(), 1);
  EXPECT_EQ(projection.active(0).tag, 1);
  EXPECT_NEAR(projection.x_m().z(), 0.5, 1e-11);
}

TEST(ProjectOnPlanes, SaysWhereNothingIsLeft) {
  PlaneProjection projection(Vector3d::Zero());
  ASSERT_TRUE(projection.add({Vector3d::UnitX(), 1.0}, 0));
  EXPECT_FALSE(projection.add({-Vector3d::UnitX(), 0.0}, 1));
}

}  // namespace
}  // namespace asperity
