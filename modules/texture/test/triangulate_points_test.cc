#include "asperity/texture/triangulate_points.h"

#include <cmath>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "asperity/base/error.h"
#include "asperity/base/random.h"

namespace asperity {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using testing::ThrowsMessage;

double area(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c) {
  return 0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
}

std::vector<PlanePoint> random_points(int count, std::uint64_t seed, double scale) {
  Random random(seed);
  std::vector<PlanePoint> points;
  for (int i = 0; i < count; ++i) points.push_back({scale * random.uniform(), scale * random.uniform()});
  return points;
}

// By brute force: no point lies within a circumcircle by more than the rounding of the grid.
void expect_delaunay(const std::vector<PlanePoint>& p, const std::vector<std::array<int, 3>>& triangles) {
  for (const auto& t : triangles) {
    const auto& a = p[static_cast<std::size_t>(t[0])];
    const auto& b = p[static_cast<std::size_t>(t[1])];
    const auto& c = p[static_cast<std::size_t>(t[2])];
    const double d = 4.0 * area(a, b, c);
    ASSERT_GT(d, 0.0);
    const double bx = b[0] - a[0], by = b[1] - a[1], cx = c[0] - a[0], cy = c[1] - a[1];
    const double ux = (cy * (bx * bx + by * by) - by * (cx * cx + cy * cy)) / d;
    const double uy = (bx * (cx * cx + cy * cy) - cx * (bx * bx + by * by)) / d;
    const double radius = std::hypot(ux, uy);
    for (const auto& q : p) EXPECT_GT(std::hypot(q[0] - a[0] - ux, q[1] - a[1] - uy), radius * (1.0 - 1e-3));
  }
}

TEST(Triangulate, CoversTheHullWithEmptyCircles) {
  const auto points = random_points(200, 7, 1.0);
  const auto triangles = triangulate_points(points);
  expect_delaunay(points, triangles);
  const auto border = border_edges(points, triangles);
  // Euler: 2n − 2 − h triangles over n points, h of them on the hull.
  EXPECT_EQ(triangles.size(), 2 * points.size() - 2 - border.size());
}

TEST(Triangulate, SameAtAnyScale) {
  EXPECT_EQ(triangulate_points(random_points(60, 8, 1.0)), triangulate_points(random_points(60, 8, 0x1p-40)));
}

TEST(Triangulate, RegularGridIsCovered) {
  std::vector<PlanePoint> points;
  for (int i = 0; i < 8; ++i) {
    for (int j = 0; j < 8; ++j) points.push_back({i / 7.0, j / 7.0});
  }
  const auto triangles = triangulate_points(points);
  EXPECT_THAT(triangles, SizeIs(98));
  double sum = 0.0;
  for (const auto& t : triangles) {
    const double a = area(points[static_cast<std::size_t>(t[0])], points[static_cast<std::size_t>(t[1])],
                          points[static_cast<std::size_t>(t[2])]);
    EXPECT_GT(a, 0.0);
    sum += a;
  }
  EXPECT_NEAR(sum, 1.0, 1e-12);
}

TEST(Triangulate, PointsOnALineAndTwinsAreNoTriangles) {
  const std::vector<PlanePoint> line{{0.5, 0.5}, {0.0, 0.0}, {1.0, 1.0}, {0.5, 0.5}};
  EXPECT_THAT(triangulate_points(line), IsEmpty());
  EXPECT_THAT(border_edges(line, {}), ElementsAre(std::array{1, 0}, std::array{0, 2}));
  EXPECT_THAT(triangulate_points(std::vector<PlanePoint>{{1.0, 2.0}}), IsEmpty());
  EXPECT_THAT(triangulate_points(std::vector<PlanePoint>{}), IsEmpty());
  // Three on a line, then one off it on either side.
  EXPECT_THAT(triangulate_points(std::vector<PlanePoint>{{0, 0}, {0, 1}, {0, 2}, {1, 1}}), SizeIs(2));
  EXPECT_THAT(triangulate_points(std::vector<PlanePoint>{{0, 0}, {1, 1}, {2, 2}, {3, 1}, {1, 0}}), SizeIs(3));
}

TEST(Triangulate, RefusesWhatIsNotFinite) {
  EXPECT_THAT(
      [] {
        triangulate_points(std::vector<PlanePoint>{{0.0, 0.0}, {INFINITY, 0.0}});
      },
      ThrowsMessage<Error>(HasSubstr("point 2 is not finite")));
}

}  // namespace
}  // namespace asperity
