#include "escape_local_minimum.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "triangle_foot.h"

namespace asperity {
namespace {

using Eigen::Vector3d;

constexpr double kAbout = 16.0;                             // radii: triangles that meet where the ball rests
constexpr double kHeights[] = {1.0, 1.25, 2.0, 8.0, 64.0};  // radii over the triangle

double nearest_m(const NearTriangles& near, const Vector3d& p_m) {
  double best_m = std::numeric_limits<double>::infinity();
  for (std::uint32_t i = 0; i < near.count; ++i) {
    const NearTriangle& t = near.triangles[i];
    if (std::abs(t.normal.dot(p_m - t.a_m)) >= best_m) continue;
    best_m = std::min(best_m, foot_on(t, p_m).distance_m);
  }
  return best_m;
}

// Whether a straight way meets no triangle of the list, each taken a little larger than it is.
bool is_clear(const NearTriangles& near, const Vector3d& from_m, const Vector3d& to_m) {
  constexpr double kWider = 0x1p-20;
  for (std::uint32_t i = 0; i < near.count; ++i) {
    const NearTriangle& t = near.triangles[i];
    const double from_height_m = t.normal.dot(from_m - t.a_m), to_height_m = t.normal.dot(to_m - t.a_m);
    if ((from_height_m > 0.0) == (to_height_m > 0.0)) continue;
    const Vector3d q_m = from_m + (from_height_m / (from_height_m - to_height_m)) * (to_m - from_m);
    const Vector3d e1 = t.b_m - t.a_m, e2 = t.c_m - t.a_m, area = e1.cross(e2);
    const double square = area.squaredNorm();
    const double b = (q_m - t.a_m).cross(e2).dot(area) / square, c = e1.cross(q_m - t.a_m).dot(area) / square;
    if (b >= -kWider && c >= -kWider && b + c <= 1.0 + kWider) return false;
  }
  return true;
}

// Straight, or over a point above the local minimum.
bool is_reachable(const NearTriangles& near, const Vector3d& from_m, const Vector3d& away, double radius_m,
                  const Vector3d& to_m) {
  if (is_clear(near, from_m, to_m)) return true;
  for (const double height : {4.0, 32.0}) {
    const Vector3d above_m = from_m + (height * radius_m) * away;
    if (is_clear(near, from_m, above_m) && is_clear(near, above_m, to_m)) return true;
  }
  return false;
}

}  // namespace

bool escape_local_minimum(ProxyState& proxy, const ProxyBall& ball, const Vector3d& goal_m,
                          std::int64_t& work) noexcept {
  const NearTriangles& near = proxy.near;
  const Vector3d from_m = proxy.p_world_m;
  const double left_m = (goal_m - from_m).norm();
  const double room_m = near.radius_m - ball.radius_m - (from_m - near.centre_m).norm();
  const Vector3d away = (from_m - goal_m) / left_m;  // in the cone of the planes that hold the ball
  // A place that counts is nearer by more than the ball may lose by its own size.
  const double nearer_m = left_m - 0.5 * kAbout * ball.radius_m;
  for (std::uint32_t i = 0; i < near.count; ++i) {
    const NearTriangle& t = near.triangles[i];
    if (!(std::abs(t.normal.dot(from_m - t.a_m)) <= kAbout * ball.radius_m)) continue;
    const TriangleFoot best = foot_on(t, goal_m);
    if (!(best.distance_m < nearer_m)) continue;
    const TriangleFoot here = foot_on(t, from_m);
    if (!(here.distance_m <= kAbout * ball.radius_m)) continue;
    const Vector3d foot_m = from_m - here.from_m;
    const Vector3d along_m = goal_m - best.from_m - foot_m;
    const double length_m = along_m.norm();
    const double reach_m = std::min(length_m, 0.5 * room_m);
    for (double step_m = 8.0 * ball.radius_m; step_m < 4.0 * reach_m; step_m *= 4.0) {
      const double way_m = std::min(step_m, reach_m);
      const Vector3d place_m = foot_m + (way_m / length_m) * along_m;
      for (const double height : kHeights) {
        if (height * ball.radius_m > way_m) break;
        for (const double side : {1.0, -1.0}) {
          const Vector3d to_m = place_m + (side * height * ball.radius_m) * t.normal;
          if (!((goal_m - to_m).norm() < left_m - ball.slack_m)) continue;
          if (work <= 0) return false;
          work -= near.count;
          if (!(nearest_m(near, to_m) >= ball.radius_m - ball.slack_m)) continue;
          work -= 4 * std::int64_t{near.count};
          if (!is_reachable(near, from_m, away, ball.radius_m, to_m)) continue;
          proxy.p_world_m = to_m;
          proxy.touch_count = 0;
          return true;
        }
      }
    }
  }
  return false;
}

}  // namespace asperity
