#include "asperity/geometry/straight_path.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "asperity/base/error.h"
#include "asperity/base/random.h"
#include "asperity/testkit/shape_meshes.h"

namespace asperity {
namespace {

using Eigen::Vector3d;

TEST(StraightPath, IsStraightInThePlaneAndStopsAtItsBorder) {
  const TriangleMesh mesh = testkit::plane_mesh({0.1, 0.1}, 20, 20, 0.24, 5);
  const MeshAdjacency adjacency = make_adjacency(mesh);
  Random random(2);
  for (int i = 0; i < 50; ++i) {
    const MeshPoint from{static_cast<std::uint32_t>(random.uniform(0.0, 800.0)), {0.3, 0.3, 0.4}};
    const double angle = random.uniform(0.0, 6.28);
    const Vector3d direction(std::cos(angle), std::sin(angle), random.normal());
    const Vector3d flat(direction.x(), direction.y(), 0.0);
    const Vector3d start = position_m(mesh, from);
    const StraightPath s = straight_path(mesh, adjacency, from, direction, 0.03);
    const Vector3d goal = start + 0.03 * flat;
    const bool inside = goal.x() > 0.0 && goal.x() < 0.1 && goal.y() > 0.0 && goal.y() < 0.1;
    EXPECT_EQ(s.whole, inside);
    if (inside) {
      EXPECT_LT((position_m(mesh, s.end) - goal).norm(), 1e-15);
    }
    EXPECT_LT(flat.cross(position_m(mesh, s.end) - start).norm(), 1e-15);
    EXPECT_LT((s.direction - flat).norm(), 1e-12);
  }
}

TEST(StraightPath, IsAHelixOnAPrism) {
  constexpr int kAround = 60;
  const TriangleMesh mesh = testkit::cylinder_mesh(0.02, 0.2, kAround, 60, 2.0 * std::numbers::pi, 4);
  const MeshAdjacency adjacency = make_adjacency(mesh);
  const MeshPoint from{3, {0.2, 0.5, 0.3}};
  const Vector3d p = position_m(mesh, from);
  const Vector3d around = Vector3d::UnitZ().cross(Vector3d(p.x(), p.y(), 0.0)).normalized();
  const StraightPath s = straight_path(mesh, adjacency, from, around + 0.7 * Vector3d::UnitZ(), 0.15);
  EXPECT_TRUE(s.whole);
  EXPECT_NEAR(s.path.s_m.back(), 0.15, 1e-14);
  // The angle to the axis stays on every facet; the first heading is square to the axis to 0.06 rad² / 2.
  const auto rise = [&](std::size_t i) { return (s.path.p_mesh_m[i + 1] - p).z() / s.path.s_m[i + 1]; };
  for (std::size_t i = 1; i + 1 < s.path.size(); ++i) EXPECT_NEAR(rise(i), rise(0), 1e-10);
}

TEST(StraightPath, OfAHalfTurnOnASphereEndsOpposite) {
  const TriangleMesh mesh = testkit::sphere_mesh(1.0, 5);
  const MeshAdjacency adjacency = make_adjacency(mesh);
  const MeshPoint from{100, {0.4, 0.3, 0.3}};
  const Vector3d p = position_m(mesh, from);
  const StraightPath s = straight_path(mesh, adjacency, from, p.unitOrthogonal(), std::numbers::pi);
  // Each edge turns the line by less than h³ about; h = 0.03 and 100 edges.
  EXPECT_LT((position_m(mesh, s.end) + p).norm(), 0.02);
}

TEST(StraightPath, GoesStraightOnWhereMoreThanTwoTrianglesMeet) {
  const TriangleMesh mesh{{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, 1, 0}, {0, 0, 1}, {0, 1, 1}},
                          {{0, 2, 3}, {0, 3, 1}, {0, 1, 5}, {0, 5, 4}, {0, 1, 7}, {0, 7, 6}}};
  const StraightPath s = straight_path(mesh, make_adjacency(mesh), {1, {0.4, 0.3, 0.3}}, Vector3d(-1.0, 0.0, 0.0), 0.6);
  EXPECT_TRUE(s.whole);
  EXPECT_LT((position_m(mesh, s.end) - Vector3d(-0.3, 0.6, 0.0)).norm(), 1e-15);
}

TEST(StraightPath, RefusesWhatIsNoLengthOrNotOnTheMesh) {
  const TriangleMesh mesh = testkit::plane_mesh({1, 1}, 1, 1);
  const MeshAdjacency adjacency = make_adjacency(mesh);
  EXPECT_THROW(straight_path(mesh, adjacency, {0, {1, 0, 0}}, Vector3d::UnitX(), -1.0), Error);
  EXPECT_THROW(straight_path(mesh, adjacency, {9, {1, 0, 0}}, Vector3d::UnitX(), 1.0), Error);
  EXPECT_FALSE(straight_path(mesh, adjacency, {0, {1, 0, 0}}, Vector3d::UnitZ(), 1.0).whole);
}

}  // namespace
}  // namespace asperity
