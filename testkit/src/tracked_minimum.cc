#include "asperity/testkit/tracked_minimum.h"

#include <span>

#include <Eigen/Geometry>

namespace asperity::testkit {
namespace {

using Eigen::Vector3d;
using Feature = SurfacePlace::Feature;

// A nearer point is one by more than rounding.
constexpr double kNearer = 1.0 - 1e-13;

Vector3d nearest_of_segment(const Vector3d& a, const Vector3d& b, const Vector3d& p, int& end) {
  const Vector3d ab = b - a;
  const double t = ab.dot(p - a), length2 = ab.squaredNorm();
  end = t <= 0.0 ? 0 : t >= length2 ? 1 : -1;
  return end == 0 ? a : end == 1 ? b : Vector3d(a + t / length2 * ab);
}

}  // namespace

NearestOfTriangle nearest_of_triangle(const Vector3d& a_m, const Vector3d& b_m, const Vector3d& c_m,
                                      const Vector3d& p_m) {
  const Vector3d corners[3] = {a_m, b_m, c_m};
  const Vector3d area = (b_m - a_m).cross(c_m - a_m);
  const double area2 = area.squaredNorm();
  bool inside = area2 > 0.0;
  for (int e = 0; e < 3 && inside; ++e) {
    const Vector3d side = corners[(e + 1) % 3] - corners[e];
    inside = area.cross(side).dot(p_m - corners[e]) >= 0.0;
  }
  if (inside) {
    // From the nearest corner, so that little is lost where p is near a corner of a large triangle.
    int k = 0;
    for (int e = 1; e < 3; ++e) {
      if ((p_m - corners[e]).squaredNorm() < (p_m - corners[k]).squaredNorm()) k = e;
    }
    return {Feature::kFace, 0, p_m - area.dot(p_m - corners[k]) / area2 * area};
  }
  NearestOfTriangle best;
  double best2 = 0.0;
  for (int e = 0; e < 3; ++e) {
    int end = -1;
    const Vector3d q = nearest_of_segment(corners[e], corners[(e + 1) % 3], p_m, end);
    const double d2 = (q - p_m).squaredNorm();
    if (e > 0 && d2 >= best2) continue;
    best2 = d2;
    best = end < 0 ? NearestOfTriangle{Feature::kEdge, e, q} : NearestOfTriangle{Feature::kVertex, (e + end) % 3, q};
  }
  return best;
}

TrackedMinimum::TrackedMinimum(const TriangleMesh& mesh) : mesh_(mesh), adjacency_(make_adjacency(mesh)) {}

const SurfacePlace& TrackedMinimum::start(std::uint32_t triangle, const Vector3d& p_m) {
  place_ = {Feature::kFace, triangle, triangle, p_m};
  descents_ = 0;
  last_m_ = p_m;
  descend(p_m);
  return place_;
}

const SurfacePlace& TrackedMinimum::follow(const Vector3d& p_m, int steps) {
  descents_ = 0;
  const Vector3d from = last_m_;
  for (int i = 1; i <= steps; ++i) {
    descend(i == steps ? p_m : Vector3d(from + static_cast<double>(i) / steps * (p_m - from)));
  }
  last_m_ = p_m;
  return place_;
}

void TrackedMinimum::descend(const Vector3d& p_m) {
  const auto nearest = [&](std::uint32_t triangle) {
    const auto& [a, b, c] = mesh_.triangles[triangle];
    const NearestOfTriangle q = nearest_of_triangle(mesh_.vertices_m[a], mesh_.vertices_m[b], mesh_.vertices_m[c], p_m);
    SurfacePlace place{q.feature, triangle, triangle, q.p_m};
    const auto k = static_cast<std::size_t>(q.corner_or_edge);
    if (q.feature == Feature::kEdge) place.index = adjacency_.edge_of_triangle[triangle][k];
    if (q.feature == Feature::kVertex) place.index = mesh_.triangles[triangle][k];
    return place;
  };
  place_ = nearest(place_.triangle);
  for (;;) {
    std::span<const std::uint32_t> around;
    if (place_.feature == Feature::kEdge) around = adjacency_.triangles_of_edge(place_.index);
    if (place_.feature == Feature::kVertex) around = adjacency_.triangles_of_vertex(place_.index);
    SurfacePlace best = place_;
    double best2 = kNearer * (place_.p_m - p_m).squaredNorm();
    bool found = false;
    for (const std::uint32_t triangle : around) {
      const SurfacePlace other = nearest(triangle);
      const double d2 = (other.p_m - p_m).squaredNorm();
      if (d2 < best2) {
        best2 = d2;
        best = other;
        found = true;
      }
    }
    if (!found) return;
    place_ = best;
    ++descents_;
  }
}

}  // namespace asperity::testkit
