#include "asperity/geometry/triangulate_polygon.h"

#include <cmath>

#include <Eigen/Geometry>

#include "asperity/base/error.h"

namespace asperity {

namespace {

using Point = Eigen::Vector2d;

// Twice the signed area of the triangle; positive if counter-clockwise.
double signed_area(const Point& a, const Point& b, const Point& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

// The polygon's points in the plane of largest projected area, counter-clockwise; empty if it has no area.
std::vector<Point> project_polygon(std::span<const Eigen::Vector3d> points) {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (std::size_t i = 2; i < points.size(); ++i) {
    normal += (points[i - 1] - points[0]).cross(points[i] - points[0]);
  }
  Eigen::Index axis = 0;
  const double largest = normal.cwiseAbs().maxCoeff(&axis);
  if (!(largest > 0.0) || !std::isfinite(largest)) return {};
  Eigen::Index first = (axis + 1) % 3;
  Eigen::Index second = (axis + 2) % 3;
  if (normal[axis] < 0.0) std::swap(first, second);
  std::vector<Point> plane;
  plane.reserve(points.size());
  for (const Eigen::Vector3d& point : points) plane.emplace_back(point[first], point[second]);
  return plane;
}

// What remains of the polygon: a ring from which ears are cut.
class Ring {
 public:
  explicit Ring(std::vector<Point> points)
      : points_(std::move(points)), next_(size()), previous_(size()), ear_(size()) {
    for (std::uint32_t i = 0; i < size(); ++i) {
      next_[i] = i + 1 < size() ? i + 1 : 0;
      previous_[i] = i > 0 ? i - 1 : size() - 1;
    }
    for (std::uint32_t i = 0; i < size(); ++i) ear_[i] = is_ear(i);
  }

  PolygonShape cut(std::vector<Triangle>& triangles) {
    PolygonShape shape = PolygonShape::kSimple;
    std::uint32_t tip = next_[0];
    for (std::uint32_t left = size(); left > 3; --left) {
      std::uint32_t step = 0;
      for (; step < left && !ear_[tip]; ++step) tip = next_[tip];
      if (step == left && !find_flat(tip, left)) {
        // A simple polygon always has an ear. From here the corners are cut as they turn.
        shape = PolygonShape::kCrossing;
        crossing_ = true;
        for (std::uint32_t i = 0; i < left; ++i, tip = next_[tip]) ear_[tip] = is_ear(tip);
        for (step = 0; step < left && !ear_[tip]; ++step) tip = next_[tip];
      }
      triangles.push_back({previous_[tip], tip, next_[tip]});
      const std::uint32_t before = previous_[tip];
      const std::uint32_t after = next_[tip];
      next_[before] = after;
      previous_[after] = before;
      // Cutting an ear of a simple polygon changes no other corner (O'Rourke, Computational Geometry in C, 1998, §1.6).
      ear_[before] = is_ear(before);
      ear_[after] = is_ear(after);
      tip = after;
    }
    triangles.push_back({previous_[tip], tip, next_[tip]});
    return shape;
  }

 private:
  std::uint32_t size() const { return static_cast<std::uint32_t>(points_.size()); }

  bool is_ear(std::uint32_t tip) const {
    const Point& a = points_[previous_[tip]];
    const Point& b = points_[tip];
    const Point& c = points_[next_[tip]];
    if (!(signed_area(a, b, c) > 0.0)) return false;
    if (crossing_) return true;
    for (std::uint32_t i = next_[next_[tip]]; i != previous_[tip]; i = next_[i]) {
      const Point& p = points_[i];
      // A corner in the same place as one of the ear's belongs to a seam that joins a hole to the outline.
      if (signed_area(a, b, p) >= 0.0 && signed_area(b, c, p) >= 0.0 && signed_area(c, a, p) >= 0.0 && p != a &&
          p != b && p != c)
        return false;
    }
    return true;
  }

  bool find_flat(std::uint32_t& tip, std::uint32_t left) const {
    for (std::uint32_t i = 0; i < left; ++i, tip = next_[tip]) {
      if (signed_area(points_[previous_[tip]], points_[tip], points_[next_[tip]]) == 0.0) return true;
    }
    return false;
  }

  std::vector<Point> points_;
  std::vector<std::uint32_t> next_;
  std::vector<std::uint32_t> previous_;
  std::vector<char> ear_;
  bool crossing_ = false;
};

}  // namespace

PolygonShape triangulate_polygon(std::span<const Eigen::Vector3d> points, std::vector<Triangle>& triangles) {
  if (points.size() < 3) throw Error("triangulate_polygon: fewer than three corners");
  std::vector<Point> plane = project_polygon(points);
  if (plane.empty()) {
    for (std::uint32_t i = 2; i < points.size(); ++i) triangles.push_back({0, i - 1, i});
    return PolygonShape::kDegenerate;
  }
  return Ring(std::move(plane)).cut(triangles);
}

}  // namespace asperity
