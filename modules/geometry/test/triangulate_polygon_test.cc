#include "asperity/geometry/triangulate_polygon.h"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <Eigen/Geometry>

#include "asperity/base/random.h"

namespace asperity {
namespace {

using testing::ElementsAre;

// A star about the origin, in a tilted plane far from it.
std::vector<Eigen::Vector3d> star(Random& random, int corners, double scale) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / corners;
    const double radius = random.uniform(0.1, 1.0);
    points.push_back(scale * (turn * Eigen::Vector3d(radius * std::cos(angle), radius * std::sin(angle), 0) +
                              Eigen::Vector3d(3, -2, 5)));
  }
  return points;
}

Eigen::Vector3d area_of(const std::vector<Eigen::Vector3d>& p, const Triangle& t) {
  return 0.5 * (p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]);
}

// The triangles of a tiling all turn like the polygon, and their areas add up to the shoelace's.
TEST(TriangulatePolygon, ConcavePolygonsAreTiled) {
  Random random(3);
  for (int trial = 0; trial < 200; ++trial) {
    const std::vector<Eigen::Vector3d> points = star(random, 4 + trial % 60, 1.0);
    std::vector<Triangle> triangles;
    ASSERT_EQ(triangulate_polygon(points, triangles), PolygonShape::kSimple);
    ASSERT_EQ(triangles.size(), points.size() - 2);
    Eigen::Vector3d shoelace = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < points.size(); ++i) shoelace += 0.5 * points[i].cross(points[(i + 1) % points.size()]);
    double area = 0.0;
    for (const Triangle& t : triangles) {
      EXPECT_GT(area_of(points, t).dot(shoelace), 0.0);
      area += area_of(points, t).norm();
    }
    EXPECT_NEAR(area, shoelace.norm(), 1e-12);
  }
}

TEST(TriangulatePolygon, PowersOfTwoChangeNothing) {
  for (const double scale : {0x1p-200, 0x1p-30, 0x1p200}) {
    Random one(9), other(9);
    std::vector<Triangle> a, b;
    triangulate_polygon(star(one, 40, 1.0), a);
    triangulate_polygon(star(other, 40, scale), b);
    EXPECT_EQ(a, b) << scale;
  }
}

TEST(TriangulatePolygon, ConvexIsAFanAndConcaveQuadsAreCutInside) {
  std::vector<Triangle> fan;
  triangulate_polygon(std::vector<Eigen::Vector3d>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, fan);
  EXPECT_THAT(fan, ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3}));
  std::vector<Triangle> dart;  // its reflex corner is 2: the cut goes through it
  triangulate_polygon(std::vector<Eigen::Vector3d>{{0, 0, 0}, {0, 2, 0}, {.5, .5, 0}, {2, 0, 0}}, dart);
  EXPECT_THAT(dart, ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3}));
  std::vector<Triangle> turned;
  triangulate_polygon(std::vector<Eigen::Vector3d>{{0, 2, 0}, {.5, .5, 0}, {2, 0, 0}, {0, 0, 0}}, turned);
  EXPECT_THAT(turned, ElementsAre(Triangle{1, 2, 3}, Triangle{1, 3, 0}));
}

TEST(TriangulatePolygon, CornersOnAnEdgeMakeNoFlatTriangle) {
  const std::vector<Eigen::Vector3d> points{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 2, 0}, {0, 2, 0}};
  std::vector<Triangle> triangles;
  EXPECT_EQ(triangulate_polygon(points, triangles), PolygonShape::kSimple);
  for (const Triangle& t : triangles) EXPECT_GT(area_of(points, t).z(), 0.0);
}

TEST(TriangulatePolygon, CrossingAndFlatPolygonsAreSaidToBe) {
  std::vector<Triangle> triangles;
  EXPECT_EQ(triangulate_polygon(std::vector<Eigen::Vector3d>{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}}, triangles),
            PolygonShape::kDegenerate);
  EXPECT_EQ(triangles.size(), 2u);
  triangles.clear();
  // A pentagram: every tip holds another corner's edges.
  std::vector<Eigen::Vector3d> pentagram;
  for (int i = 0; i < 5; ++i)
    pentagram.emplace_back(std::cos(0.8 * std::numbers::pi * i), std::sin(0.8 * std::numbers::pi * i), 0.0);
  triangulate_polygon(pentagram, triangles);
  EXPECT_EQ(triangles.size(), 3u);
}

}  // namespace
}  // namespace asperity
